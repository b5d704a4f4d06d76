// What makes the collapse of an edge of a solid inadmissible: one rule, one function.
#pragma once
#include "collapse_rules.hpp"
#include "local_quadric.hpp"
#include "solid_complex.hpp"

namespace tetlod {

/// The part of their shape that flat tets have to keep; the flattest, below this shape, keep all.
struct KeptOfFlat {
  double part, flattest;
};

/// The tets around an edge. False where there are too many to bother, or nothing would be left of them.
bool look_around(const SolidComplex &mesh, std::int32_t stays, std::int32_t gone, SolidEdge &edge);

/// The same of a vertex inside that moves into its neighbour, whose other tets stay as they are. False also where a tet
/// would be flattened, as below.
bool look_around_removal(const SolidComplex &mesh, std::int32_t stays, std::int32_t gone, const KeptOfFlat &kept,
                         SolidEdge &edge);

/// A tet would turn over, or be flat and keep less of its shape. Where none does, the links of the ends
/// share no more than that of the edge [Dey et al. 1999] if they do so in the surface: positive tets in a simple
/// surface cover each place once.
bool flattens(const SolidComplex &mesh, const SolidEdge &edge, const Vec3 &place, const KeptOfFlat &kept);

/// An edge between vertices of the boundary, as the rules of the surface see its collapse. False where it is none of
/// the boundary's edges, and where the surface's links share more than that of the edge.
bool look_around_on_boundary(const SolidComplex &mesh, const SolidEdge &edge, const Vec3 &place, Star &star);

/// Which ends of an edge of the boundary lie on the planes of all triangles around the other one, so that the shape
/// stays what it is there.
struct EndsOnPlanes {
  bool stays, gone;
};
EndsOnPlanes ends_on_planes(const SolidComplex &mesh, const SolidEdge &edge);

/// What a step of the new vertex, from `from` on, must be to keep the volume [Lindstrom and Turk]: six times as much is
/// lost as it is missed by. It does not hold where the surface is too crumpled to have a normal.
StepConstraint keeping_volume(const SolidComplex &mesh, const SolidEdge &edge, const Vec3 &from);

}  // namespace tetlod

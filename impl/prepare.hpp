// The caller's arrays become the mesh that the stages read: checked, coincident points merged, tets without volume out.
#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "extract_boundary.hpp"
#include "geometry.hpp"
#include "host_numbers.hpp"
#include "job.hpp"
#include "mesh.hpp"
#include "pipeline.hpp"

namespace tetlod {

/// Two points that became one, whose values of a field are farthest from what counts there: so far.
struct Spread {
  double distance = 0;
  std::int32_t lowest = 0, highest = 0;
};

/// The original mesh; the caller's own arrays where their layout allows, copies where not.
struct Original {
  explicit Original(Memory &memory)
      : points(&memory),
        moved(&memory),
        scalars(&memory),
        tets(&memory),
        tet_number(&memory),
        replaced(&memory),
        replaced_number(&memory),
        flags(&memory),
        used(&memory),
        left(&memory),
        next_merged(&memory),
        counts(&memory),
        torn(&memory),
        jumps(&memory),
        moves(memory) {}
  MeshView view;
  Array<Vec3> points;
  Array<Vec3> moved;      ///< the view's, where some have been moved; else empty
  Array<double> scalars;  ///< with those of the further fields that steer, and of merged points the middles
  Array<Tet> tets;
  Array<std::int32_t> tet_number;       ///< of each tet among the submitted ones; empty: none was dropped
  Array<Tet> replaced;                  ///< that others take the place of: make_conforming
  Array<std::int32_t> replaced_number;  ///< of each of them, as above
  Array<std::uint8_t> flags;          ///< of each vertex, those of points that became it included; empty: none are set
  Array<std::uint8_t> used;           ///< of each submitted point: a submitted tet has it, and all of it is finite
  Array<std::uint8_t> left;           ///< of each: a tet of the view has it; empty: none was dropped
  Array<std::int32_t> next_merged;    ///< of each point, the next one that became the same, or -1; empty: none did
  Array<std::uint8_t> counts;         ///< of each, whether a submitted tet that is left has it; empty with that
  Torn torn;                          ///< parts whose points did not, though they have faces in common
  std::int64_t merged_points = 0;     ///< coincident points that became one
  bool merging_depends = false;       ///< on whether parts may be in contact, and on max-deviation
  Jumps jumps;                        ///< on which it depends which points became one
  std::int64_t nonfinite_points = 0;  ///< without a finite value, ignored with their tets
  std::int64_t dropped_tets = 0;      ///< with such a point, or with a repeated vertex, as submitted or after merging
  PointMoves moves;
  double boundary_moved_by = 0;              ///< the farthest of those opened, and of those upright on the boundary
  std::int32_t index_base = 0;               ///< as submitted
  int exponent = 0;                          ///< the view's coordinates are the caller's divided by 2^exponent
  double scalar_min = 0, scalar_max = 0;     ///< over the vertices that tets of the view have
  std::array<Spread, most_fields> spread{};  ///< of each field that steers
  ValueRange<most_fields> spread_range;      ///< of values of points that became one, where they differ
  double spread_error = 0;                   ///< the largest spread of any field: as if all ranges were the first's
  double range = 0;  ///< of the scalars; where they are constant and another field is not, something in its place
  /// The first of those whose errors are nothing beside the scalars', or theirs beside its own; 0: none.
  std::size_t unequal_field = 0;
  Box box;  ///< of the vertices that tets of the view have

  /// Points of a result in the view's scale.
  Span<const Vec3> in_scale(Span<const Vec3> points, Array<Vec3> &copy) const {
    if (exponent == 0) return points;
    copy.reserve(points.size());
    for (const Vec3 &p : points) copy.push_back(times_power_of_two(p, -exponent));
    return copy;
  }
  HostNumbers numbers() const { return {index_base, {}, tet_number}; }

  bool has_merged(std::size_t v) const { return !next_merged.empty() && view.used[v] && next_merged[v] >= 0; }
  /// visit(u): the submitted points that became v, and count.
  template <class Visit>
  void for_each_merged(std::size_t v, const Visit &visit) const {
    for (auto u = std::int32_t(v); u >= 0; u = next_merged[std::size_t(u)])
      if (counts[std::size_t(u)]) visit(std::size_t(u));
  }
};

/// The power of two that coordinates in this box have to be divided by, so that products of six lengths stay in the
/// range of doubles; 0 unless they are extreme.
int extreme_exponent(const Box &box);

/// Throws Status::argument (as many values and flags as points), mesh_empty, mesh_too_large.
void check_counts(const Input &input);
/// The same for a field that has so many tuples.
void check_count(const Input &input, const std::string &field, std::int64_t tuples, Association association);

/// Coordinates so large or small that their sixth powers leave the range of doubles are scaled, exactly.
/// Throws what check_counts does, mesh_index, mesh_nonfinite.
void prepare_original(const Input &input, const Options &options, Job &job, Original &original,
                      const PointMoves *made = nullptr);

/// Then: extract_boundary. What it leaves out of the view, flat tets that hang on it and those given twice, is dropped,
/// and points that no other tet has are none of the mesh any more. Where overlaps are repaired, vertices
/// are moved, these or find_moves(), and then make_conforming. Where the boundary is not sound with cracks that are
/// open, and moves are not given, it is anew without, and so is original.
void prepare_boundary(const Input &input, const Options &options, Job &job, Original &original, Boundary &boundary,
                      const PointMoves *made = nullptr);

/// prepare_original and prepare_boundary.
void prepare_with_boundary(const Input &input, const Options &options, Job &job, Original &original, Boundary &boundary,
                           const PointMoves *made = nullptr);

/// The same as prepare_original of a mesh whose points, tets, flags and options are what they were, and other values.
/// False: it takes prepare_original, because the values change what the mesh is, or are none.
bool renew_values(const Input &input, Job &job, Original &original);

/// In all fields that steer, as far as these have a value for the submitted point.
bool has_finite_values(const Input &input, std::int64_t point);

}  // namespace tetlod

// Tets that others take the place of, with their numbers among the submitted ones, and their boundary.
#pragma once
#include <numeric>

#include "extract_boundary.hpp"
#include "status.hpp"

namespace tetlod {

struct NumberedTets {
  /// number: of each; empty: they are the submitted ones.
  NumberedTets(const MeshView &mesh, Span<const std::int32_t> number_of, Memory &memory)
      : points(mesh.points),
        tets(mesh.tets.begin(), mesh.tets.end(), &memory),
        number(number_of.begin(), number_of.end(), &memory),
        boundary(memory) {
    if (!number.empty()) return;
    number.resize(tets.size());
    std::iota(number.begin(), number.end(), 0);
  }

  MeshView view() const { return without_fields(points, tets); }

  /// Anew. False: they have none, or not all of them.
  bool find_boundary(Job &job) {
    boundary = Boundary(job.memory);
    try {
      extract_boundary(view(), job, boundary);
    } catch (const Error &error) {
      if (error.status() != Status::mesh_nonmanifold && error.status() != Status::mesh_degenerate &&
          error.status() != Status::mesh_too_large)
        throw;
      return false;
    }
    return boundary.excluded.empty();
  }

  Span<const Vec3> points;
  Array<Tet> tets;
  Array<std::int32_t> number;
  Boundary boundary;
};

}  // namespace tetlod

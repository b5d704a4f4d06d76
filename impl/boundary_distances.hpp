// How far the boundaries of the original and of a coarse mesh are apart, while the mesh's changes.
#pragma once
#include "few.hpp"
#include "geometry.hpp"
#include "job.hpp"
#include "mesh.hpp"
#include "surface_distance.hpp"

namespace tetlod {

/// At an original vertex, at one of the mesh, or at the middle of a triangle of the mesh.
struct Apart {
  enum Where { at_sample, at_vertex, at_middle };
  double distance;
  std::size_t at;
  Where where;
  bool operator<(const Apart &o) const {
    if (distance != o.distance) return distance > o.distance;
    return where != o.where ? where < o.where : at < o.at;
  }
};

/// A place for a vertex, with the values of the original's boundary where that is nearest.
struct Aim {
  Vec3 point, nearest;
  Few<double, most_fields> values;
  std::int32_t origin;  ///< the original vertex that it is, or -1
  double distance() const { return glm::length(point - nearest); }
};

/// Of a change: all that is concerned is within the limit, or no farther off than before; the original vertex that is
/// served, if one is (else -1), is within it.
struct Goal {
  double limit;
  std::int64_t served;
};

/// Between surfaces of that size: what is no farther is not off.
double distance_of_rounding(const Surface &original);

/// Of each point, the triangle of the mesh's boundary that it is nearest to, or -1, and its distance.
void find_homes(Span<const Vec3> points, const TetMesh &mesh, Job &job, Array<std::int32_t> &home,
                Array<double> &distance);

class BoundaryDistances {
 public:
  /// to_original: its tree. origin: as in lower_deviation.
  BoundaryDistances(const Surface &original, const TriangleTree &to_original, const TetMesh &mesh,
                    Span<const std::int32_t> origin, Job &job);

  /// Those of more than `least`, largest first, but no more than so many.
  Array<Apart> worst(double least, std::size_t most) const;
  bool is_still(const Apart &apart) const;
  /// From a vertex of either boundary.
  double largest() const;

  /// The triangle of the mesh that an original vertex is nearest to, or -1.
  std::int32_t home(std::size_t sample) const { return home_[sample]; }
  Aim aim_at(std::size_t sample) const;
  Aim aim_near(const Vec3 &p) const;

  /// Whether the goal is reached for all that triangles stand for with others in their places, and for the middles of
  /// these.
  bool suit(Span<const std::int32_t> old, Span<const Triangle> fresh, const Goal &goal);
  /// Those that suited have come: the first ones into the old places, further ones after the last.
  void take(Span<const std::int32_t> old);
  /// The mesh's vertex has come there, or comes after the last.
  void take(std::int32_t v, const Aim &aim);

 private:
  /// Of a sample: the one of the fresh triangles that is nearest.
  struct Home {
    std::int32_t sample;
    std::size_t triangle;
    double distance;
  };

  void measure_samples();
  void measure_vertices(Span<const std::int32_t> origin);
  void measure_middles();
  double value_at(const Triangle &t, const Vec3 &weights, std::size_t field) const;
  double distance_of_middle(const Triangle &t) const;
  Home home_among(Span<const Triangle> fresh, std::int32_t sample) const;
  bool find_new_homes(Span<const std::int32_t> old, Span<const Triangle> fresh, const Goal &goal);
  bool find_middles(Span<const std::int32_t> old, Span<const Triangle> fresh, double limit);
  const Array<double> &distances(Apart::Where where) const;

  const Surface &original_;
  const TetMesh &mesh_;
  Job &job_;
  double of_rounding_;
  const TriangleTree &to_original_;
  Array<double> of_sample_, of_vertex_, of_middle_;
  Array<std::int32_t> first_, next_, home_;  // lists of the original's vertices, by nearest triangle
  Array<Home> fresh_homes_;                  // of the last that suited
  Array<double> fresh_middles_;
};

}  // namespace tetlod

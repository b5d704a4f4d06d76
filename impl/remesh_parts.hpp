// A surface and its samples in parts that are remeshed each for itself: solids, small ones together.
#pragma once
#include <cstddef>
#include <cstdint>

#include "job.hpp"
#include "mesh.hpp"
#include "remesh.hpp"
#include "remesh_checks.hpp"

namespace tetlod {

/// What TetGen is given at once.
struct RemeshPart {
  explicit RemeshPart(Memory &memory) : surface(memory), samples(&memory) {}
  Surface surface;  ///< points and triangles alone
  Array<Vec3> samples;
  std::int64_t components = 0;  ///< as in SurfaceFacts
};

/// What is which part depends on the surface and the samples alone.
class RemeshParts {
 public:
  /// Solids with together at most `points_at_once` points and samples are one part, and so is a solid with more. The
  /// surface has passed check_surface(); it, its facts and the samples live as long as this.
  RemeshParts(const Surface &surface, const SurfaceFacts &facts, Span<const Vec3> samples, std::size_t points_at_once,
              Job &job);

  std::size_t count() const { return points_.count(); }
  /// Of its surface, and samples.
  std::size_t size(std::size_t part) const { return points_.of(part).size() + samples_.of(part).size(); }
  RemeshPart part(std::size_t part) const;
  /// Makes the results of all parts, in their order, that of the whole, but for what its report says of attempts and of
  /// the worker. They are used up.
  void join(Span<RemeshResult> results, RemeshResult &whole) const;

 private:
  /// The numbers of things, those of each part together, ascending.
  class Drawers {
   public:
    explicit Drawers(Memory &memory) : end_(&memory), items_(&memory) {}
    /// Things of part -1 are in none.
    void fill(Span<const std::int32_t> part_of, std::size_t parts);
    std::size_t count() const { return end_.size(); }
    Span<const std::int32_t> of(std::size_t part) const {
      const std::size_t begin = part ? end_[part - 1] : 0;
      return {items_.data() + begin, end_[part] - begin};
    }

   private:
    Array<std::size_t> end_;
    Array<std::int32_t> items_;
  };

  Array<std::int32_t> number_samples(Span<const RemeshResult> results) const;
  void append(std::size_t part, Span<const std::int32_t> number_of_sample, const RemeshResult &result,
              RemeshResult &whole) const;

  const Surface &surface_;
  const SurfaceFacts &facts_;
  Span<const Vec3> given_samples_;
  Job &job_;
  Drawers points_, triangles_, samples_;
  Array<std::int32_t> number_in_part_;  // of each point
};

}  // namespace tetlod

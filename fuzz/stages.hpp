// The library's stages, called without the C ABI.
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <vector>

#include "decoder.hpp"
#include "host.hpp"
#include "job.hpp"
#include "memory.hpp"
#include "mesh.hpp"
#include "pipeline.hpp"
#include "reference.hpp"
#include "status.hpp"

namespace fuzz {

/// Memory that fails, and a job that is cancelled, at some allocation; and nothing may be left of it in the end.
class Stage {
 public:
  explicit Stage(Bytes &in);
  ~Stage();
  Stage(const Stage &) = delete;
  Stage &operator=(const Stage &) = delete;

  tetlod::Memory &memory() { return memory_; }
  tetlod::Job &job() { return job_; }
  /// From here on an allocation may fail or cancel.
  void trouble(Bytes &in);
  /// Nothing fails any more.
  void calm();

  /// Status::ok, or that of the Error that came: one of those, or one that the trouble explains.
  tetlod::Status call(const char *what, std::initializer_list<tetlod::Status> documented,
                      const std::function<void()> &body);

 private:
  Allocator allocator_;
  std::atomic<bool> cancel_{false};
  bool fails_ = false, cancels_ = false;
  tetlod::Memory memory_;
  tetlod::Parallel parallel_;
  tetlod::Job job_;
};

/// A mesh as the stages take it; it borrows.
class MeshInput {
 public:
  explicit MeshInput(const Mesh &mesh);
  const tetlod::Input &input() const { return input_; }

 private:
  std::vector<Point> points_;
  std::vector<double> values_;
  std::vector<Corners> tets_;
  tetlod::Input input_;
};

std::vector<Point> points_of(tetlod::Span<const tetlod::Vec3> points);
std::vector<Face> faces_of(tetlod::Span<const tetlod::Triangle> triangles);
std::vector<Corners> tets_of(tetlod::Span<const tetlod::Tet> tets);

}  // namespace fuzz

#include "stages.hpp"

#include <algorithm>

#include "demand.hpp"

namespace fuzz {

namespace {

tetlod::AllocatorHooks hooks_of(Allocator &allocator) {
  tetlod_config config{};
  allocator.install(config);
  return {config.allocate, config.release, config.allocator_user};
}

tetlod::StridedArray strided(tetlod::ElementType type, std::size_t tuples, int components, const void *data) {
  tetlod::StridedArray array;
  array.type = type;
  array.tuples = std::int64_t(tuples);
  array.components = components;
  array.component_stride = 8;
  array.tuple_stride = 8 * components;
  array.data = static_cast<unsigned char *>(const_cast<void *>(data));
  array.present = true;
  return array;
}

}  // namespace

Stage::Stage(Bytes &in) : memory_(hooks_of(allocator_)), parallel_(in.one_in(4) ? 2 : 1), job_(memory_, parallel_) {
  job_.cancel = &cancel_;
  job_.time_limit = 20;
  job_.log = [](int, const char *message) { trace("%s\n", message); };
  trouble(in);
}

void Stage::trouble(Bytes &in) {
  fails_ = in.one_in(12);
  cancels_ = !fails_ && in.one_in(12);
  if (fails_) allocator_.fail_after(long(in.below(400)));
  if (cancels_) allocator_.call_after(long(in.below(400)), [this] { cancel_ = true; });
}

Stage::~Stage() {
  DEMAND(memory_.in_use() == 0 && allocator_.in_use() == 0, "all memory is given back: %zu bytes are not",
         memory_.in_use());
}

void Stage::calm() {
  allocator_.forget();
  cancel_ = fails_ = cancels_ = false;
}

tetlod::Status Stage::call(const char *what, std::initializer_list<tetlod::Status> documented,
                           const std::function<void()> &body) {
  using tetlod::Status;
  try {
    body();
    return Status::ok;
  } catch (const tetlod::Error &error) {
    const Status status = error.status();
    const bool explained = (status == Status::memory && fails_) || (status == Status::cancelled && cancels_);
    DEMAND(explained || std::count(documented.begin(), documented.end(), status), "%s: status %d is documented: %s",
           what, int(status), error.what());
    DEMAND(*error.what(), "%s: an error has a message", what);
    return status;
  }
}

MeshInput::MeshInput(const Mesh &mesh) : points_(mesh.points), values_(mesh.values), tets_(mesh.tets) {
  for (std::size_t k = 0; k < 3; k++) {
    input_.xyz[k] =
        strided(tetlod::ElementType::float64, points_.size(), 1, points_.empty() ? nullptr : points_[0].data() + k);
    input_.xyz[k].tuple_stride = sizeof(Point);
  }
  input_.tets = strided(tetlod::ElementType::int64, tets_.size(), 4, tets_.data());
  input_.scalars = strided(tetlod::ElementType::float64, values_.size(), 1, values_.data());
}

std::vector<Point> points_of(tetlod::Span<const tetlod::Vec3> points) {
  std::vector<Point> copy;
  for (const tetlod::Vec3 &p : points) copy.push_back({p.x, p.y, p.z});
  return copy;
}

std::vector<Face> faces_of(tetlod::Span<const tetlod::Triangle> triangles) {
  std::vector<Face> copy;
  for (const tetlod::Triangle &t : triangles) copy.push_back({t[0], t[1], t[2]});
  return copy;
}

std::vector<Corners> tets_of(tetlod::Span<const tetlod::Tet> tets) {
  std::vector<Corners> copy;
  for (const tetlod::Tet &t : tets) copy.push_back({t[0], t[1], t[2], t[3]});
  return copy;
}

}  // namespace fuzz

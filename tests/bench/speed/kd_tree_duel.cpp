#include "kd_tree_duel.hpp"

#include <cmath>
#include <limits>
#include <memory>

#include "extract_boundary.hpp"
#include "kd_tree.hpp"
#include "sample_interior.hpp"
#include "stages.hpp"

#if HAS_NANOFLANN
#include <nanoflann.hpp>
#endif

namespace bench {
namespace {

constexpr std::int64_t kLeaf = 10;  // nanoflann's default
constexpr std::size_t kMostQueries = 500000;
constexpr double kRho = 0.01;

// Numbers of points, as a cloud that nanoflann reads.
struct Cloud {
  const std::vector<Point> &points;
  std::vector<std::int32_t> numbers;
  std::size_t kdtree_get_point_count() const { return numbers.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[std::size_t(numbers[i])][axis]; }
  template <class B>
  bool kdtree_get_bbox(B &) const {
    return false;
  }
};

std::vector<std::int32_t> all_numbers(const Mesh &mesh) {
  std::vector<std::int32_t> numbers(mesh.points.size());
  for (std::size_t i = 0; i < numbers.size(); i++) numbers[i] = std::int32_t(i);
  return numbers;
}

// Centroids of tets.
std::vector<Point> queries_of(const Mesh &mesh) {
  const std::size_t step = 1 + mesh.tets.size() / kMostQueries;
  std::vector<Point> queries;
  for (std::size_t t = 0; t < mesh.tets.size(); t += step) {
    Point centroid{};
    for (const std::int32_t corner : mesh.tets[t]) {
      for (std::size_t a = 0; a < 3; a++) centroid[a] += 0.25 * mesh.points[std::size_t(corner)][a];
    }
    queries.push_back(centroid);
  }
  return queries;
}

// ---- Ours ----

class OurTree {
 public:
  explicit OurTree(const Mesh &mesh) : view_(view_of(mesh)), tree_(stages_.memory) {}

  Cost build() {
    const Stopwatch watch;
    tetlod::Array<tetlod::Box> boxes(&stages_.memory);
    boxes.reserve(view_.points.size());
    for (const tetlod::Vec3 &p : view_.points) boxes.push_back({p, p});
    tree_.build(std::move(boxes), kLeaf, stages_.job);
    return watch.cost();
  }

  Cost find(const std::vector<Point> &queries, double &sum) const {
    const Stopwatch watch;
    sum = 0;
    for (const Point &q : queries) {
      const tetlod::Vec3 p(q[0], q[1], q[2]);
      double best = std::numeric_limits<double>::infinity();
      tree_.nearest(p, best, [&](std::int32_t v) {
        const tetlod::Vec3 d = view_.points[std::size_t(v)] - p;
        return glm::dot(d, d);
      });
      sum += best;
    }
    return watch.cost();
  }

 private:
  Stages stages_{1};
  tetlod::MeshView view_;
  tetlod::KdTree tree_;
};

class SamplingTree {
 public:
  explicit SamplingTree(const Mesh &mesh)
      : mesh_(view_of(mesh)), variation_(kRho * range_of(mesh.values)), boundary_(stages_.memory) {
    tetlod::extract_boundary(mesh_, stages_.job, boundary_);
  }
  std::vector<std::int32_t> vertices() const { return {boundary_.interior.begin(), boundary_.interior.end()}; }

  Cost sample() {
    std::vector<std::int32_t> order = vertices();  // it is changed
    tetlod::Array<std::int32_t> samples(&stages_.memory);
    const Stopwatch watch;
    tetlod::sample_interior(mesh_, {order.data(), order.size()}, variation_, stages_.job, samples);
    return watch.cost();
  }

 private:
  Stages stages_{1};
  tetlod::MeshView mesh_;
  double variation_;
  tetlod::Boundary boundary_;
};

// ---- Theirs ----

#if HAS_NANOFLANN
class TheirTree {
 public:
  TheirTree(const Mesh &mesh, std::vector<std::int32_t> numbers) : cloud_{mesh.points, std::move(numbers)} {}

  Cost build() {
    const Stopwatch watch;
    tree_ = std::make_unique<Tree>(3, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(kLeaf));
    tree_->buildIndex();
    return watch.cost();
  }

  Cost find(const std::vector<Point> &queries, double &sum) const {
    const Stopwatch watch;
    sum = 0;
    for (const Point &q : queries) {
      std::uint32_t nearest = 0;
      double best = 0;
      tree_->knnSearch(q.data(), 1, &nearest, &best);
      sum += best;
    }
    return watch.cost();
  }

 private:
  using Metric = nanoflann::L2_Simple_Adaptor<double, Cloud>;
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud, 3>;
  Cloud cloud_;
  std::unique_ptr<Tree> tree_;
};
#else
class TheirTree {
 public:
  TheirTree(const Mesh &, std::vector<std::int32_t>) {}
  Cost build() { throw NoRival("needs libnanoflann-dev when it is built"); }
  Cost find(const std::vector<Point> &, double &) const { throw NoRival("needs libnanoflann-dev when it is built"); }
};
#endif

}  // namespace

std::vector<Duel> hold_kd_tree_duels(const std::string &set, const Mesh &mesh, int rounds) {
  const std::string rival = "nanoflann";
  OurTree ours(mesh);
  TheirTree theirs(mesh, all_numbers(mesh));
  std::vector<Duel> duels;
  duels.push_back(hold_duel(
      "k-d tree over vertices: building", set, rival, rounds, [&] { return ours.build(); },
      [&] { return theirs.build(); }));
  const std::vector<Point> queries = queries_of(mesh);
  double our_sum = 0, their_sum = 0;
  duels.push_back(hold_duel(
      "k-d tree over vertices: nearest", set, rival, rounds, [&] { return ours.find(queries, our_sum); },
      [&] { return theirs.find(queries, their_sum); }));
  if (duels.back().skipped.empty() && std::fabs(our_sum - their_sum) > 1e-9 * their_sum) {
    throw std::runtime_error("the k-d trees disagree about the nearest vertices of " + set);
  }
  SamplingTree sampling(mesh);
  TheirTree interior(mesh, sampling.vertices());
  duels.push_back(hold_duel(
      "sampling tree, against building one", set, rival, rounds, [&] { return sampling.sample(); },
      [&] { return interior.build(); }));
  return duels;
}

}  // namespace bench

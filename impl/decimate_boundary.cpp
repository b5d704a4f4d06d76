#include "decimate_boundary.hpp"

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <algorithm>
#include <cmath>

#include "boundary_limits.hpp"
#include "collapse_rules.hpp"
#include "edge_queue.hpp"
#include "field_quadric.hpp"
#include "vertex_sums.hpp"

namespace tetlod {

namespace {

using Mesh = OpenMesh::TriConnectivity;
using HalfedgeHandle = OpenMesh::HalfedgeHandle;
using VertexHandle = OpenMesh::VertexHandle;

/// OpenMesh allocates from the heap; this is what it takes for a triangle: half a vertex, one and a half edges.
constexpr std::size_t openmesh_bytes_a_triangle = 100;
constexpr double usually_strays = 0.02, strays_at_most = 0.25;

template <class T>
auto &at(T &array, OpenMesh::BaseHandle handle) {
  return array[std::size_t(handle.idx())];
}

template <std::size_t m>
class Decimator {
 public:
  Decimator(const Surface &surface, const SurfaceTopology &topology, Span<const std::uint8_t> locked,
            const DecimateOptions &options, CollapseLog &log, Job &job)
      : surface_(surface),
        job_(job),
        log_(log),
        lambda_(options.lambda),
        charge_(job.memory, openmesh_bytes_a_triangle * surface.triangles.size()),
        queue_(3 * surface.triangles.size() / 2, job) {
    copy_vertices(topology, locked);
    copy_connectivity(topology, job, mesh_);
    copy_triangles(topology);
    for_each(point_.size(), job, [&](std::size_t v) { update_sums(VertexHandle(int(v))); });
    if (options.max_deviation > 0)
      limits_.limit_deviation(surface, tree_.emplace(surface.points, surface.triangles, job), options.max_deviation,
                              job);
    if (options.sees_fields()) quadrics_.find(options.field_weight, triangle_, point_, values_);
    if (options.careful) limits_.guard_crossings(point_, triangle_, id_, job);
  }

  std::int64_t edges() const { return edges_; }

  /// Collapses the edge of lowest cost until `target` edges are left; with a limit on the length the cost is the
  /// length.
  void collapse_until(std::int64_t target, double length_limit) {
    by_length_ = length_limit > 0;
    const std::int64_t start = edges_;
    for (std::size_t e = 0; e < mesh_.n_edges(); e++) {
      if (e % 16384 == 0) job_.poll(0);
      update_cost(OpenMesh::EdgeHandle(int(e)));
    }
    for (std::int64_t step = 0; edges_ > target && !queue_.empty(); step++) {
      if (step % 64 == 0) job_.poll(double(start - edges_) / double(std::max<std::int64_t>(start - target, 1)));
      const OpenMesh::EdgeHandle edge(queue_.top());
      if (by_length_ && queue_.cost(edge.idx()) > length_limit * length_limit) break;
      if (!quadrics_.empty() && !by_length_ && is_dearer_now(edge)) continue;
      queue_.remove(edge.idx());
      try_collapse(edge);
    }
    while (!queue_.empty()) queue_.remove(queue_.top());
  }

  /// By the paper's cost, vertices go farther off where edges run out before.
  void collapse_to(std::int64_t target) {
    if (quadrics_.empty()) may_stray_ = usually_strays;
    collapse_until(target, 0);
    if (edges_ <= target || !strayed_) return;
    may_stray_ = strays_at_most;
    collapse_until(target, 0);
  }

  /// What is left, the cut welded again.
  void write(Surface &out) const {
    for (auto f = mesh_.faces_sbegin(); f != mesh_.faces_end(); ++f) out.triangles.push_back(at(triangle_, *f));
    out.fields = m;
    weld({point_, {values_.data()->data(), m * values_.size()}, origin_, id_}, surface_.points.size(), job_, out);
  }

 private:
  // ---- Setting up

  void copy_vertices(const SurfaceTopology &topology, Span<const std::uint8_t> locked) {
    for (std::int32_t id : topology.vertex_of) {
      const auto i = std::size_t(id);
      job_.poll_at(id_.size(), 0);
      point_.push_back(surface_.points[i]);
      values_.push_back(reinterpret_cast<const Values<m> *>(surface_.scalars.data())[i]);
      origin_.push_back(surface_.origin[i]);
      id_.push_back(id);
      touching_.push_back(topology.touching[i]);
      locked_.push_back(topology.touching[i] || (!locked.empty() && locked[i]));
    }
    sums_.resize(point_.size(), job_);
  }

  void copy_triangles(const SurfaceTopology &topology) {
    for (std::size_t t = 0; t < surface_.triangles.size(); t++) {
      job_.poll_at(t, 0);
      Triangle vertices{};
      for (std::size_t k = 0; k < 3; k++) vertices[k] = topology.sheet_vertex[3 * t + k];
      triangle_.push_back(vertices);
      plane_.push_back(plane_of(point(vertices[0]), point(vertices[1]), point(vertices[2])));
    }
    edges_ = std::int64_t(mesh_.n_edges());
    stamp_.assign(mesh_.n_edges(), 0);
  }

  // ---- Geometry of what is there

  const Vec3 &point(std::int32_t v) const { return point_[std::size_t(v)]; }
  const Vec3 &point(VertexHandle v) const { return point_[std::size_t(v.idx())]; }

  void update_sums(VertexHandle v) {
    sums_.update(
        mesh_, v, [&](HalfedgeHandle h) { return at(plane_, mesh_.face_handle(h)); },
        [&](HalfedgeHandle h) { return point(mesh_.to_vertex_handle(h)); });
  }

  // ---- Placement and cost

  struct Placement {
    Vec3 point;
    Values<m> values;
    double cost;
  };

  LinkSums link_of(HalfedgeHandle h) const {
    const HalfedgeHandle o = mesh_.opposite_halfedge_handle(h);
    const VertexHandle from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
    LinkSums link = sums_.link(from.idx(), to.idx());
    for (VertexHandle v : {from, to, apex(mesh_, h), apex(mesh_, o)}) link.add(point(v), -1);
    return link;
  }

  Placement place(HalfedgeHandle h) const {
    const HalfedgeHandle o = mesh_.opposite_halfedge_handle(h);
    const VertexHandle from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
    const double length2_e = length2(point(to) - point(from));
    const LinkSums link = link_of(h);
    VolumeSums volume = sums_.volume(from.idx(), to.idx());
    for (HalfedgeHandle side : {h, o}) volume.add(at(plane_, mesh_.face_handle(side)), -1);
    const VertexHandle fixed = at(locked_, from) ? from : at(locked_, to) ? to : VertexHandle();
    if (fixed.is_valid() && changes_volume(volume, point(fixed), length2_e))
      return {point(fixed), at(values_, fixed), std::numeric_limits<double>::infinity()};
    if (!quadrics_.empty()) return place_in_field(from, to, fixed, volume, link, length2_e);
    const Vec3 x = fixed.is_valid() ? point(fixed) : place_vertex(volume, link, length2_e, lambda_);
    const Values<m> values = values_along_edge(x, point(from), point(to), at(values_, from), at(values_, to));
    return {x, values, collapse_cost(link, x, length2_e)};
  }

  Placement place_in_field(VertexHandle from, VertexHandle to, VertexHandle fixed, const VolumeSums &volume,
                           const LinkSums &link, double length2_e) const {
    const FieldQuadric<3 + m> quadric = quadrics_.of_edge(from.idx(), to.idx());
    Values<m> mean;
    for (std::size_t k = 0; k < m; k++) mean[k] = 0.5 * at(values_, from)[k] + 0.5 * at(values_, to)[k];
    Vector<3 + m> x = quadrics_.with_values(0.5 * (point(from) + point(to)), mean);
    if (fixed.is_valid()) {
      x = quadrics_.with_values(point(fixed), at(values_, fixed));
    } else if (!place_by_quadric(quadric, volume, x)) {
      return {point(to), mean, std::numeric_limits<double>::infinity()};
    }
    return {{x[0], x[1], x[2]}, quadrics_.values_of(x), collapse_cost(quadric(x), x, link, length2_e)};
  }

  /// Where both ends may move, of the best place along the edge, which is known sooner than the best of all.
  double cost_in_field(HalfedgeHandle h) const {
    const VertexHandle from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
    if (at(locked_, from) || at(locked_, to)) return place(h).cost;
    Vector<3 + m> x;
    const double least =
        least_along_edge(quadrics_.of_edge(from.idx(), to.idx()), quadrics_.with_values(point(from), at(values_, from)),
                         quadrics_.with_values(point(to), at(values_, to)), x);
    return collapse_cost(least, x, link_of(h), length2(point(to) - point(from)));
  }

  double cost(HalfedgeHandle h) const {
    if (by_length_) return length2(point(mesh_.to_vertex_handle(h)) - point(mesh_.from_vertex_handle(h)));
    return quadrics_.empty() ? place(h).cost : cost_in_field(h);
  }

  void update_cost(OpenMesh::EdgeHandle edge) {
    if (mesh_.status(edge).deleted()) return;
    const HalfedgeHandle h = mesh_.halfedge_handle(edge, 0);
    const VertexHandle from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
    if (at(locked_, from) && at(locked_, to)) {
      queue_.remove(edge.idx());  // it may have been there before a collapse gave it its second fixed end
      return;
    }
    const double now = cost(h);
    if (std::isfinite(now))
      queue_.set(edge.idx(), now);
    else
      queue_.remove(edge.idx());
  }

  /// Costs around a collapse that its quadrics leave alone are brought up to date when their turn comes.
  bool is_dearer_now(OpenMesh::EdgeHandle edge) {
    const double cost = queue_.cost(edge.idx());
    update_cost(edge);
    return queue_.empty() || queue_.top() != edge.idx() || queue_.cost(edge.idx()) > cost + 0.5 * std::abs(cost);
  }

  // ---- Admissibility

  /// No pillow of two triangles: with the link condition (pinches_ring), the surface stays a manifold of the same
  /// topology.
  bool leaves_pillow(HalfedgeHandle h) const {
    const HalfedgeHandle o = mesh_.opposite_halfedge_handle(h);
    return sums_.neighbours(apex(mesh_, h).idx()) <= 3 || sums_.neighbours(apex(mesh_, o).idx()) <= 3;
  }

  /// `to`, where the surface touches itself, would get an edge that another sheet has or may get: to a vertex that is
  /// also touched, or to one that has an edge to `to` in another sheet.
  bool joins_sheets(HalfedgeHandle h) const {
    const VertexHandle from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
    if (!at(touching_, to)) return false;
    const auto is_other_sheet = [&](HalfedgeHandle out) {
      const VertexHandle w = mesh_.to_vertex_handle(out);
      return w != to && at(id_, w) == at(id_, to);
    };
    return any_around(mesh_, from, [&](HalfedgeHandle out) {
      const VertexHandle v = mesh_.to_vertex_handle(out);
      return v != to && (at(touching_, v) || any_around(mesh_, v, is_other_sheet));
    });
  }

  /// Fills star_; false when the link is too long to bother.
  bool look_around(HalfedgeHandle h, const Vec3 &centre) {
    if (sums_.is_hub(mesh_.from_vertex_handle(h).idx()) || sums_.is_hub(mesh_.to_vertex_handle(h).idx())) return false;
    star_.clear();
    star_.centre = centre;
    star_.centre_id = std::int32_t(surface_.points.size());
    const HalfedgeHandle o = mesh_.opposite_halfedge_handle(h);
    for (HalfedgeHandle side : {h, o}) star_.old_faces.push_back(mesh_.face_handle(side).idx());
    // Around `to` from behind the left triangle to the right one, then around `from`.
    for (HalfedgeHandle side : {o, h}) {
      HalfedgeHandle spoke = next_around(mesh_, side);
      for (HalfedgeHandle last = mesh_.next_halfedge_handle(mesh_.opposite_halfedge_handle(side)); spoke != last;
           spoke = next_around(mesh_, spoke))
        add_to_star(spoke);
    }
    if (const VertexHandle to = mesh_.to_vertex_handle(h); at(locked_, to)) star_.centre_id = at(id_, to);
    star_.find_spokes();
    return star_.size() <= longest_ring;
  }

  /// The triangle counter-clockwise of a half-edge that leaves an end of the edge, and its ring edge.
  void add_to_star(HalfedgeHandle spoke) {
    const OpenMesh::FaceHandle face = mesh_.face_handle(spoke);
    const HalfedgeHandle ring_edge = mesh_.next_halfedge_handle(spoke);
    const VertexHandle v = mesh_.to_vertex_handle(spoke);
    star_.ring.push_back(point(v));
    star_.ring_id.push_back(at(id_, v));
    star_.old_normal.push_back(at(plane_, face).normal);
    star_.outer_normal.push_back(at(plane_, mesh_.face_handle(mesh_.opposite_halfedge_handle(ring_edge))).normal);
    star_.old_faces.push_back(face.idx());
    const Triangle &t = at(triangle_, face);
    star_.old_quality = std::min(star_.old_quality, triangle_quality(point(t[0]), point(t[1]), point(t[2])));
  }

  // ---- The collapse

  void try_collapse(OpenMesh::EdgeHandle edge) {
    HalfedgeHandle h = mesh_.halfedge_handle(edge, 0);
    if (at(locked_, mesh_.from_vertex_handle(h))) h = mesh_.opposite_halfedge_handle(h);
    const Vec3 &from = point(mesh_.from_vertex_handle(h)), &to = point(mesh_.to_vertex_handle(h));
    const Placement placement = place(h);
    if (!std::isfinite(placement.cost) || leaves_pillow(h) || joins_sheets(h) || !look_around(h, placement.point))
      return;
    const bool goes_far = strays(star_, from, to, may_stray_);
    strayed_ |= goes_far;
    if (goes_far || pinches_ring(star_) || turns_too_far(star_) || folds(star_) || makes_sliver(star_)) return;
    if (!limits_.are_passed(star_, samples_)) collapse(h, placement);
  }

  /// `from` disappears, `to` moves unless it is locked.
  void collapse(HalfedgeHandle h, const Placement &placement) {
    const VertexHandle from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
    const HalfedgeHandle o = mesh_.opposite_halfedge_handle(h);
    log_.collapses.push_back({from.idx(), to.idx(), !at(locked_, to), placement.point});
    log_.scalars.insert(log_.scalars.end(), placement.values.begin(), placement.values.end());
    if (!at(locked_, to)) {
      at(values_, to) = placement.values;
      at(point_, to) = placement.point;
      at(origin_, to) = -1;
    }
    if (!quadrics_.empty()) quadrics_.merge(from.idx(), to.idx());
    for (HalfedgeHandle side : {h, o}) {
      const HalfedgeHandle next = mesh_.next_halfedge_handle(side);
      for (HalfedgeHandle gone : {side, next, mesh_.next_halfedge_handle(next)})
        queue_.remove(mesh_.edge_handle(gone).idx());
    }
    collapse_edge(h, mesh_);
    limits_.move_on(star_, samples_);
    edges_ -= 3;
    update_around(to);
  }

  void update_around(VertexHandle centre) {
    for_each_around(mesh_, centre, [&](HalfedgeHandle h) { update_face(h); });
    update_sums(centre);
    for_each_around(mesh_, centre, [&](HalfedgeHandle h) {
      const VertexHandle v = mesh_.to_vertex_handle(h);
      if (!sums_.stays_hub(v.idx())) update_sums(v);
    });
    now_++;
    const bool are_all_current = quadrics_.empty() || by_length_;
    if (!are_all_current) return update_costs_at(centre);
    for_each_around(mesh_, centre, [&](HalfedgeHandle h) {
      const VertexHandle v = mesh_.to_vertex_handle(h);
      if (!sums_.is_hub(v.idx())) update_costs_at(v);
    });
  }

  void update_face(HalfedgeHandle spoke) {
    const OpenMesh::FaceHandle face = mesh_.face_handle(spoke);
    const Triangle t{mesh_.from_vertex_handle(spoke).idx(), mesh_.to_vertex_handle(spoke).idx(),
                     apex(mesh_, spoke).idx()};
    at(triangle_, face) = t;
    at(plane_, face) = plane_of(point(t[0]), point(t[1]), point(t[2]));
  }

  void update_costs_at(VertexHandle v) {
    for_each_around(mesh_, v, [&](HalfedgeHandle h) {
      const OpenMesh::EdgeHandle edge = mesh_.edge_handle(h);
      if (at(stamp_, edge) == now_) return;
      at(stamp_, edge) = now_;
      update_cost(edge);
    });
  }

  const Surface &surface_;
  Job &job_;
  CollapseLog &log_;
  double lambda_, may_stray_ = std::numeric_limits<double>::infinity();
  bool by_length_ = false, strayed_ = false;
  std::int64_t edges_ = 0;
  MemoryCharge charge_;
  Mesh mesh_;
  Array<Vec3> point_{&job_.memory};
  Array<Values<m>> values_{&job_.memory};
  Array<std::int32_t> id_{&job_.memory}, origin_{&job_.memory};
  Array<std::uint8_t> locked_{&job_.memory}, touching_{&job_.memory};
  Array<Triangle> triangle_{&job_.memory};
  Array<TrianglePlane> plane_{&job_.memory};
  std::optional<TriangleTree> tree_;  // of the surface, for a limit
  BoundaryLimits limits_;
  SamplesOfStar samples_{job_.memory};
  FieldQuadrics<m> quadrics_{job_.memory};  // empty: the paper's cost
  VertexSums sums_{job_.memory};
  Array<std::int32_t> stamp_{&job_.memory};
  std::int32_t now_ = 0;
  EdgeQueue queue_;
  Star star_{job_.memory};
};

template <std::size_t m>
DecimateReport decimate(Surface &surface, const SurfaceTopology &topology, Span<const std::uint8_t> locked,
                        const DecimateOptions &options, Job &job, CollapseLog &log) {
  Decimator<m> decimator(surface, topology, locked, options, log, job);
  DecimateReport report;
  report.edges_in = decimator.edges();
  const std::int64_t target = edges_kept(options.sigma, report.edges_in);
  if (options.clean_edges > 0) decimator.collapse_until(0, options.clean_edges * box_of(surface.points).diagonal());
  report.cleaned_edges = log.cleaned = std::int64_t(log.collapses.size());
  decimator.collapse_to(target);
  report.edges_out = decimator.edges();
  log.exhausted = report.edges_out > target;
  Surface simplified(job.memory);
  decimator.write(simplified);
  job.poll(1);
  surface = std::move(simplified);
  return report;
}

}  // namespace

DecimateReport decimate_boundary(Surface &surface, const SurfaceTopology &topology, Span<const std::uint8_t> locked,
                                 const DecimateOptions &options, Job &job, CollapseLog &log) {
  return with_fields(surface.fields, [&](auto m) { return decimate<m>(surface, topology, locked, options, job, log); });
}

}  // namespace tetlod

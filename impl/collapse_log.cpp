#include "collapse_log.hpp"

#include <algorithm>

#include "geometry.hpp"

namespace tetlod {

namespace {

class Replay {
 public:
  Replay(const Surface &surface, const SurfaceTopology &topology, Job &job)
      : topology_(topology), job_(job), fields_(surface.fields) {
    for (std::int32_t id : topology.vertex_of) {
      point_.push_back(surface.points[std::size_t(id)]);
      for (std::size_t k = 0; k < fields_; k++) scalar_.push_back(surface.scalars[std::size_t(id) * fields_ + k]);
      origin_.push_back(surface.origin[std::size_t(id)]);
      into_.push_back(std::int32_t(into_.size()));
    }
    touched_.resize(into_.size(), 0);
  }

  /// logged: its values; null: they lie along the edge.
  void collapse(const Collapse &c, const double *logged) {
    const auto from = std::size_t(c.from), to = std::size_t(c.to);
    if (c.moves) {
      for (std::size_t k = 0; k < fields_; k++) {
        double &value = scalar_[to * fields_ + k];
        value = logged ? logged[k]
                       : value_along_edge(c.point, point_[from], point_[to], scalar_[from * fields_ + k], value);
      }
      point_[to] = c.point;
      origin_[to] = -1;
    }
    into_[from] = c.to;
    touched_[to] = ++now_;
  }

  void write(std::size_t surface_points, Surface &out) {
    for (std::size_t h = 0; h < topology_.sheet_vertex.size(); h += 3) {
      Triangle t{};
      for (std::size_t k = 0; k < 3; k++) t[k] = survivor(topology_.sheet_vertex[h + k]);
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      begin_at_last_centre(t);
      out.triangles.push_back(t);
    }
    out.fields = fields_;
    weld({point_, scalar_, origin_, topology_.vertex_of}, surface_points, job_, out);
  }

 private:
  std::int32_t survivor(std::int32_t v) {
    while (into_[std::size_t(v)] != v) {
      std::int32_t &next = into_[std::size_t(v)];
      next = into_[std::size_t(next)];
      v = next;
    }
    return v;
  }

  /// A collapse names the triangles around its vertex from that on.
  void begin_at_last_centre(Triangle &t) const {
    const auto later = [&](std::int32_t a, std::int32_t b) {
      return touched_[std::size_t(a)] < touched_[std::size_t(b)];
    };
    std::rotate(t.begin(), std::max_element(t.begin(), t.end(), later), t.end());
  }

  const SurfaceTopology &topology_;
  Job &job_;
  std::size_t fields_;
  Array<Vec3> point_{&job_.memory};
  Array<double> scalar_{&job_.memory};
  Array<std::int32_t> origin_{&job_.memory};
  Array<std::int32_t> into_{&job_.memory};     // of each vertex: itself, or one that it became
  Array<std::int32_t> touched_{&job_.memory};  // when a collapse last had it as its centre; 0: never
  std::int32_t now_ = 0;
};

}  // namespace

std::int64_t collapses_to(double sigma, std::int64_t edges, const CollapseLog &log) {
  const std::int64_t surplus = edges - 3 * log.cleaned - edges_kept(sigma, edges);  // a collapse takes three edges
  const std::int64_t needed = log.cleaned + std::max<std::int64_t>(surplus + 2, 0) / 3;
  const auto available = std::int64_t(log.collapses.size());
  if (needed <= available) return needed;
  return log.exhausted ? available : -1;
}

void weld(const CutVertices &vertices, std::size_t surface_points, Job &job, Surface &out) {
  Array<std::int32_t> number(surface_points, -1, &job.memory);
  for (std::size_t t = 0; t < out.triangles.size(); t++) {
    job.poll_at(t, 1);
    for (std::int32_t &corner : out.triangles[t]) {
      const auto v = std::size_t(corner);
      std::int32_t &n = number[std::size_t(vertices.id[v])];
      if (n < 0) {
        n = std::int32_t(out.points.size());
        out.points.push_back(vertices.points[v]);
        for (std::size_t k = 0; k < out.fields; k++) out.scalars.push_back(vertices.scalars[v * out.fields + k]);
        out.origin.push_back(vertices.origin[v]);
      }
      corner = n;
    }
  }
}

void replay(const CollapseLog &log, std::size_t count, const SurfaceTopology &topology, MovedValues values, Job &job,
            Surface &surface) {
  Replay again(surface, topology, job);
  for (std::size_t i = 0; i < count; i++) {
    job.poll_at(i, double(i) / double(count));
    again.collapse(log.collapses[i], values == MovedValues::logged ? &log.scalars[i * surface.fields] : nullptr);
  }
  Surface simplified(job.memory);
  again.write(surface.points.size(), simplified);
  surface = std::move(simplified);
}

}  // namespace tetlod

#include "extract_boundary.hpp"

#include <algorithm>

#include "predicates.hpp"
#include "status.hpp"

namespace tetlod {

namespace {

/// A face in the bucket of its lowest vertex.
struct Face {
  std::int32_t middle, high;  // the two other vertices
  std::uint32_t use;          // 4 t + k: the face of tet t opposite its corner k
};

struct FaceVertices {
  std::int32_t low, middle, high;
};

FaceVertices sorted_face(const Tet &t, int k) {
  std::int32_t a = t[std::size_t(tet_face[k][0])], b = t[std::size_t(tet_face[k][1])],
               c = t[std::size_t(tet_face[k][2])];
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  return {a, b, c};
}

/// Faces by their lowest vertex: one counting sort, then small buckets that fit the cache.
class FaceBuckets {
 public:
  FaceBuckets(const MeshView &mesh, Span<const std::uint8_t> peeled, Job &job)
      : mesh_(mesh), peeled_(peeled), job_(job), begin_(&job.memory), faces_(&job.memory) {
    begin_.assign(mesh.points.size() + 1, 0);
    for_each_face([&](const FaceVertices &f, std::uint32_t) { begin_[std::size_t(f.low) + 1]++; });
    job.poll(0.2);
    for (std::size_t v = 0; v + 1 < begin_.size(); v++) begin_[v + 1] += begin_[v];
    faces_.resize(begin_.back());
    Array<std::uint32_t> place(begin_, &job.memory);
    for_each_face([&](const FaceVertices &f, std::uint32_t use) {
      faces_[place[std::size_t(f.low)]++] = {f.middle, f.high, use};
    });
    job.poll(0.6);
  }

  /// Sorts every bucket and leaves the faces used once, in order, with their bucket's count in `once`.
  void keep_used_once(Array<std::uint32_t> &once) {
    once.assign(begin_.size() - 1, 0);
    job_.parallel.for_blocks(once.size(), 4096, [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; v++) once[v] = keep_used_once_in(v);
      job_.poll(0.8);
    });
  }

  Span<const Face> bucket(std::size_t v) const { return {faces_.data() + begin_[v], begin_[v + 1] - begin_[v]}; }

 private:
  template <class Visit>
  void for_each_face(const Visit &visit) const {
    for (std::size_t t = 0; t < mesh_.tets.size(); t++) {
      if (!peeled_.empty() && peeled_[t]) continue;
      for (int k = 0; k < 4; k++) visit(sorted_face(mesh_.tets[t], k), std::uint32_t(4 * t + std::size_t(k)));
    }
  }

  std::uint32_t keep_used_once_in(std::size_t v) {
    Face *const first = faces_.data() + begin_[v], *const last = faces_.data() + begin_[v + 1];
    std::sort(first, last, [](const Face &a, const Face &b) {
      return a.middle != b.middle ? a.middle < b.middle : a.high != b.high ? a.high < b.high : a.use < b.use;
    });
    Face *out = first;
    for (Face *f = first; f != last;) {
      Face *g = f + 1;
      while (g != last && g->middle == f->middle && g->high == f->high) g++;
      if (g - f > 2)
        fail(Status::mesh_nonmanifold, "%d tets share the face of vertices %zu, %d and %d (the first are tets %u, %u, %u)",
             int(g - f), v, int(f->middle), int(f->high), f->use / 4, f[1].use / 4, f[2].use / 4);
      if (g - f == 1) *out++ = *f;
      f = g;
    }
    return std::uint32_t(out - first);
  }

  const MeshView &mesh_;
  Span<const std::uint8_t> peeled_;
  Job &job_;
  Array<std::uint32_t> begin_;
  Array<Face> faces_;
};

int tet_sign(const MeshView &mesh, const Tet &t) {
  return orientation(mesh.points[std::size_t(t[0])], mesh.points[std::size_t(t[1])], mesh.points[std::size_t(t[2])],
                      mesh.points[std::size_t(t[3])]);
}

Triangle outward_face(const Tet &t, int k, int sign) {
  Triangle face{t[std::size_t(tet_face[k][0])], t[std::size_t(tet_face[k][1])], t[std::size_t(tet_face[k][2])]};
  if (sign < 0) std::swap(face[1], face[2]);
  return face;
}

/// Collects the faces used once. A tet of the boundary that is flat cannot say which way
/// is out: it is marked in `peeled`, and the answer is how many were.
std::int64_t collect(const MeshView &mesh, Array<std::uint8_t> &peeled, Job &job, Boundary &boundary) {
  FaceBuckets buckets(mesh, peeled, job);
  Array<std::uint32_t> once(&job.memory);
  buckets.keep_used_once(once);
  std::int64_t flat = 0;
  boundary.triangles.clear();
  boundary.tet_of.clear();
  for (std::size_t v = 0; v < once.size(); v++)
    for (std::size_t i = 0; i < once[v]; i++) {
      const std::uint32_t use = buckets.bucket(v)[i].use;
      const std::size_t t = use / 4;
      const int sign = tet_sign(mesh, mesh.tets[t]);
      if (sign != 0) {
        boundary.triangles.push_back(outward_face(mesh.tets[t], int(use % 4), sign));
        boundary.tet_of.push_back(std::int32_t(t));
        continue;
      }
      peeled.resize(mesh.tets.size(), 0);
      flat += peeled[t] == 0;
      peeled[t] = 1;
    }
  return flat;
}

void find_interior(const MeshView &mesh, Span<const std::uint8_t> peeled, Job &job, Boundary &boundary) {
  enum : std::uint8_t { unused, used, on_boundary };
  Array<std::uint8_t> place(mesh.points.size(), unused, &job.memory);
  for (std::size_t t = 0; t < mesh.tets.size(); t++)
    if (peeled.empty() || !peeled[t])
      for (std::int32_t v : mesh.tets[t]) place[std::size_t(v)] = used;
  for (const Triangle &t : boundary.triangles)
    for (std::int32_t v : t) place[std::size_t(v)] = on_boundary;
  for (std::size_t v = 0; v < place.size(); v++) {
    if (place[v] == used) boundary.interior.push_back(std::int32_t(v));
    boundary.unused_points += place[v] == unused;
  }
}

}  // namespace

void extract_boundary(const MeshView &mesh, Job &job, Boundary &boundary) {
  Array<std::uint8_t> peeled(&job.memory);
  while (const std::int64_t flat = collect(mesh, peeled, job, boundary)) boundary.flat_tets += flat;
  if (boundary.triangles.empty())
    fail(Status::mesh_degenerate, "none of the %zu tets has a volume", mesh.tets.size());
  find_interior(mesh, peeled, job, boundary);
}

void make_surface(const MeshView &mesh, Span<const Triangle> triangles, Job &job, Surface &surface) {
  Array<std::int32_t> number(mesh.points.size(), -1, &job.memory);
  surface.triangles.reserve(triangles.size());
  for (const Triangle &t : triangles) {
    Triangle renumbered;
    for (std::size_t k = 0; k < 3; k++) {
      std::int32_t &n = number[std::size_t(t[k])];
      if (n < 0) {
        n = std::int32_t(surface.points.size());
        surface.points.push_back(mesh.points[std::size_t(t[k])]);
        surface.scalars.push_back(mesh.scalars[std::size_t(t[k])]);
        surface.origin.push_back(t[k]);
      }
      renumbered[k] = n;
    }
    surface.triangles.push_back(renumbered);
  }
}

}  // namespace tetlod

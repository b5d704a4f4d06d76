#include "tet_complex.hpp"

#include <algorithm>

#include "face_sweep.hpp"

namespace tetlod {

Triangle sorted_face(const Tet &t, int k) {
  Triangle f = face_opposite(t, std::size_t(k));
  if (f[0] > f[1]) std::swap(f[0], f[1]);
  if (f[1] > f[2]) std::swap(f[1], f[2]);
  if (f[0] > f[1]) std::swap(f[0], f[1]);
  return f;
}

void TetComplex::find_neighbours(Job &job) {
  neighbours.assign(tets.size(), Tet{-1, -1, -1, -1});
  free_.clear();
  job.poll(0.1);
  touched_.assign(tets.size(), 0);
  tet_of.assign(points.size(), -1);
  const MeshView view{points, {}, tets};
  FaceSweep(view, {}, job).visit([&](std::size_t, std::int32_t, const FaceUse *first, const FaceUse *last) {
    if (last - first != 2) return;
    neighbours[first[0].tet()][first[0].corner()] = std::int32_t(first[1].tet());
    neighbours[first[1].tet()][first[1].corner()] = std::int32_t(first[0].tet());
  });
  for (std::size_t t = 0; t < tets.size(); t++) {
    job.poll_at(t, 0.1);
    for (const std::int32_t v : tets[t]) tet_of[std::size_t(v)] = std::int32_t(t);
  }
}

void TetComplex::connect(Job &job) {
  find_neighbours(job);
  fixed.assign(points.size(), 0);
  for (std::size_t t = 0; t < tets.size(); t++) {
    job.poll_at(t, 0.1);
    for (std::size_t k = 0; k < 4; k++)
      if (neighbours[t][k] < 0)
        for (int corner : tet_face[k]) fixed[std::size_t(tets[t][std::size_t(corner)])] = 1;
  }
  find_touching(job);
}

/// Where the solid touches itself at a vertex, or along an edge.
void TetComplex::find_touching(Job &job) {
  Array<std::int32_t> count(points.size(), 0, &memory_);
  for (std::size_t t = 0; t < tets.size(); t++) {
    job.poll_at(t, 0.1);
    for (std::int32_t v : tets[t]) count[std::size_t(v)]++;
  }
  job.parallel.for_blocks(points.size(), 512, [&](std::size_t begin, std::size_t end) {
    Array<std::int32_t> around(&memory_), rim(&memory_);
    for (std::size_t v = begin; v < end; v++) {
      if (!fixed[v]) continue;
      star(std::int32_t(v), around);
      if (std::int32_t(around.size()) != count[v] || touches_along_edge(std::int32_t(v), around, rim))
        fixed[v] = touching;
    }
    job.poll(0.1);
  });
}

/// around: the tets of v. Of an edge of the boundary two of its triangles have both ends.
bool TetComplex::touches_along_edge(std::int32_t v, Span<const std::int32_t> around, Array<std::int32_t> &rim) const {
  rim.clear();
  for (std::int32_t t : around)
    for (std::size_t k = 0; k < 4; k++) {
      if (neighbours[std::size_t(t)][k] >= 0 || tets[std::size_t(t)][k] == v) continue;
      for (int corner : tet_face[k])
        if (const std::int32_t u = tets[std::size_t(t)][std::size_t(corner)]; u != v) rim.push_back(u);
    }
  std::sort(rim.begin(), rim.end());
  for (std::size_t i = 2; i < rim.size(); i++)
    if (rim[i] == rim[i - 2]) return true;
  return false;
}

std::int32_t TetComplex::slot() {
  if (!free_.empty()) {
    const std::int32_t t = free_.back();
    free_.pop_back();
    return t;
  }
  tets.push_back({});
  neighbours.push_back({});
  touched_.push_back(0);
  return std::int32_t(tets.size()) - 1;
}

void TetComplex::replace_tets(Span<const std::int32_t> old, Span<const Tet> fresh, Array<std::int32_t> &made) {
  outer_.clear();
  for (std::int32_t t : old) {
    for (int k = 0; k < 4; k++) {
      const std::int32_t beyond = neighbours[std::size_t(t)][std::size_t(k)];
      if (std::find(old.begin(), old.end(), beyond) != old.end()) continue;
      const Triangle face = sorted_face(tets[std::size_t(t)], k);
      int side = 0;  // of two tets with two faces in common the one with this face
      if (beyond >= 0)
        while (side < 3 && (neighbours[std::size_t(beyond)][std::size_t(side)] != t ||
                            sorted_face(tets[std::size_t(beyond)], side) != face))
          side++;
      outer_.push_back({face, beyond, side});
    }
  }
  for (std::size_t i = old.size(); i-- > 0;) {
    tets[std::size_t(old[i])][0] = -1;
    touch(old[i]);
    free_.push_back(old[i]);
  }
  made.clear();
  for (const Tet &t : fresh) {
    const std::int32_t s = slot();
    made.push_back(s);
    tets[std::size_t(s)] = t;
    neighbours[std::size_t(s)] = {-1, -1, -1, -1};
    for (std::int32_t v : t) tet_of[std::size_t(v)] = s;
    // A face of the cavity's wall, or one that another fresh tet waits with; what nobody claims is boundary.
    for (int k = 0; k < 4; k++) {
      const Triangle f = sorted_face(t, k);
      const auto wall =
          std::find_if(outer_.begin(), outer_.end(), [&](const OuterFace &face) { return face.vertices == f; });
      if (wall == outer_.end()) {
        outer_.push_back({f, s, k});
        continue;
      }
      neighbours[std::size_t(s)][std::size_t(k)] = wall->beyond;
      if (wall->beyond >= 0) neighbours[std::size_t(wall->beyond)][std::size_t(wall->side)] = s;
      *wall = outer_.back();
      outer_.pop_back();
    }
  }
}

bool TetComplex::star(std::int32_t v, Cavity &around) const {
  around.clear();
  around.push(tet_of[std::size_t(v)]);
  return flood(&v, 1, around, [&](std::int32_t t) { return around.push(t); });
}

void TetComplex::tets_with(std::int32_t t, const std::int32_t *simplex, std::size_t size,
                           Array<std::int32_t> &around) const {
  around.clear();
  around.push_back(t);
  flood(simplex, size, around, [&](std::int32_t n) {
    around.push_back(n);
    return true;
  });
}

void TetComplex::find_boundary(Array<Triangle> &faces, Array<std::int32_t> &tet_of_face) const {
  for (std::size_t t = 0; t < tets.size(); t++)
    for (int k = 0; k < 4; k++)
      if (alive(std::int32_t(t)) && neighbours[t][std::size_t(k)] < 0) {
        faces.push_back(sorted_face(tets[t], k));
        tet_of_face.push_back(std::int32_t(t));
      }
}

}  // namespace tetlod

#include "remesh_result.hpp"

#include <algorithm>
#include <utility>

#include "exact_order.hpp"
#include "geometry.hpp"
#include "key_file.hpp"
#include "status.hpp"
#include "tet_checks.hpp"

namespace tetlod {

namespace {

constexpr std::int32_t nobody = -1;  // number of a Steiner point; slot of a point that is not there

bool points_unchanged(const RemeshInput &input, const TetgenReply &reply) {
  return reply.points.size() >= input.points.size() &&
         std::equal(input.points.begin(), input.points.end(), reply.points.begin());
}

/// TetGen winds all tets one way, which may be the other than ours.
void wind_positively(TetgenReply &reply, double fraction, Job &job) {
  if (six_volumes(reply.points, reply.tets, fraction, job) >= 0) return;
  for (Tet &tet : reply.tets) std::swap(tet[2], tet[3]);
}

bool contains(const KeyFile &faces, std::int32_t vertex, std::uint64_t key) {
  const Span<const std::uint64_t> keys = faces.of(std::size_t(vertex));
  return std::binary_search(keys.begin(), keys.end(), key);
}

/// What boundary triangles say about the region that a tet beside them is in.
enum Vote : unsigned char { none = 0, material = 1, empty = 2, contradiction = 3 };

Array<unsigned char> vote(const RemeshInput &input, const TetgenReply &reply, double fraction, Job &job) {
  KeyFile boundary(job.memory);
  file_faces(input.triangles, reply.points.size(), fraction, job, boundary);
  Array<unsigned char> votes(reply.tets.size() + 1, none, &job.memory);
  for (std::size_t i = 0; i < reply.tets.size(); i++) {
    job.poll_at(i, fraction);
    unsigned char &region = votes[std::size_t(reply.regions[i])];
    for (int k = 0; k < 4; k++) {
      const FaceKey face(face_opposite(reply.tets[i], std::size_t(k)));
      if (contains(boundary, face.vertex, face.key)) region |= material;
      if (contains(boundary, face.vertex, face.other_side())) region |= empty;
    }
  }
  return votes;
}

/// With switch A cavities come filled, as regions of their own.
std::string remove_cavities(const RemeshInput &input, TetgenReply &reply, double fraction, Job &job) {
  if (reply.regions.empty()) return {};
  const Array<unsigned char> votes = vote(input, reply, fraction, job);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < reply.tets.size(); i++) {
    const unsigned char region = votes[std::size_t(reply.regions[i])];
    if (region == none || region == contradiction)
      return text("region %d is neither inside nor outside", reply.regions[i]);
    if (region == material) reply.tets[kept++] = reply.tets[i];
  }
  reply.tets.resize(kept);
  return {};
}

/// Two users of a face, seen from both sides, are as it should be: two tets, or a tet and the outside.
bool is_paired(Span<const std::uint64_t> keys) {
  if (keys.size() % 2) return false;
  for (std::size_t i = 0; i < keys.size(); i += 2) {
    if (keys[i] & 1 || keys[i + 1] != (keys[i] | 1)) return false;
    if (i + 2 < keys.size() && keys[i + 2] == keys[i + 1]) return false;
  }
  return true;
}

/// Given triangles count as faces of the outside. Then every face is used exactly twice, or else a tet is missing, one
/// is too many, or the boundary is not the given one.
std::string check_faces(const RemeshInput &input, const TetgenReply &reply, double fraction, Job &job) {
  KeyFile faces(job.memory);
  const auto enumerate = [&](const auto &visit) {
    for (const Triangle &t : input.triangles) {
      const FaceKey face(t);
      visit(face.vertex, face.other_side());
    }
    for (std::size_t i = 0; i < reply.tets.size(); i++) {
      job.poll_at(i, fraction);
      for (int k = 0; k < 4; k++) {
        const FaceKey face(face_opposite(reply.tets[i], std::size_t(k)));
        visit(face.vertex, face.key);
      }
    }
  };
  faces.build(reply.points.size(), enumerate, fraction, job);
  for (std::size_t v = 0; v < faces.vertices(); v++) {
    job.poll_at(v, fraction);
    if (!is_paired(faces.of(v))) return text("the faces at point %zu do not match the boundary", v);
  }
  return {};
}

/// Points by their exact place, to know samples again that came by -i.
class PlaceIndex {
 public:
  PlaceIndex(Span<const Vec3> points, Job &job) : points_(points), order_(in_exact_order(points, job)) {}
  /// The lowest index of a point at this place, or -1.
  std::int32_t find(const Vec3 &place) const {
    const auto found = std::lower_bound(order_.begin(), order_.end(), place,
                                        [&](std::int32_t i, const Vec3 &p) { return is_before(at(i), p); });
    return found == order_.end() || is_before(place, at(*found)) ? nobody : *found;
  }

 private:
  const Vec3 &at(std::int32_t i) const { return points_[std::size_t(i)]; }
  Span<const Vec3> points_;
  Array<std::int32_t> order_;
};

/// The number (see RemeshInput) of every point of the reply; nobody: a Steiner point.
Array<std::int32_t> numbers(const RemeshInput &input, const TetgenReply &reply, Job &job) {
  Array<std::int32_t> number(reply.points.size(), nobody, &job.memory);
  std::copy(input.number.begin(), input.number.end(), number.begin());
  if (input.insert.empty()) return number;
  const PlaceIndex places(input.insert, job);
  for (std::size_t i = input.points.size(); i < number.size(); i++) {
    const std::int32_t found = places.find(reply.points[i]);
    if (found != nobody) number[i] = input.insert_number[std::size_t(found)];
  }
  return number;
}

/// Numbers the points that tets use: the surface's in their order, samples in theirs, then Steiner points.
class Numbering {
 public:
  Numbering(const RemeshInput &input, const TetgenReply &reply, std::size_t known, Job &job)
      : number_(numbers(input, reply, job)),
        slot_(known, nobody, &job.memory),
        new_(number_.size(), nobody, &job.memory) {
    Array<char> used(number_.size(), 0, &job.memory);
    for (const Tet &tet : reply.tets)
      for (const std::int32_t corner : tet) used[std::size_t(corner)] = 1;
    for (std::size_t i = 0; i < used.size(); i++)
      if (used[i]) claim(std::int32_t(i));
    for (const std::int32_t point : slot_)
      if (point != nobody) new_[std::size_t(point)] = count_++;
    for (std::size_t i = 0; i < used.size(); i++)
      if (used[i] && new_[i] == nobody) new_[i] = count_++;
  }

  std::int32_t count() const { return count_; }
  /// The point of the reply that is a surface point or sample, or -1 when no tet uses one.
  std::int32_t slot(std::size_t number) const { return slot_[number]; }
  std::int32_t number(std::size_t point) const { return number_[point]; }
  std::int32_t renumbered(std::int32_t point) const { return new_[std::size_t(point)]; }

 private:
  /// Of two points at the same place one is the sample; the other is nobody we know.
  void claim(std::int32_t point) {
    std::int32_t &number = number_[std::size_t(point)];
    if (number == nobody) return;
    std::int32_t &slot = slot_[std::size_t(number)];
    if (slot == nobody)
      slot = point;
    else
      number = nobody;
  }

  Array<std::int32_t> number_, slot_, new_;
  std::int32_t count_ = 0;
};

std::string check_surface_used(const Numbering &numbering, const Surface &surface) {
  for (std::size_t i = 0; i < surface.points.size(); i++)
    if (numbering.slot(i) == nobody) return text("boundary vertex %zu is missing", i);
  return {};
}

/// Surface points and samples are copied from what the caller gave, so that they are bitwise the same.
void fill_result(const RemeshInput &input, const Surface &surface, Span<const Vec3> samples, const TetgenReply &reply,
                 const Numbering &numbering, RemeshResult &result) {
  result.points.resize(std::size_t(numbering.count()));
  result.origin.resize(std::size_t(numbering.count()));
  const std::size_t boundary = surface.points.size();
  for (std::size_t i = 0; i < reply.points.size(); i++) {
    const std::int32_t target = numbering.renumbered(std::int32_t(i));
    if (target == nobody) continue;
    const std::int32_t number = numbering.number(i);
    Vec3 &point = result.points[std::size_t(target)];
    result.origin[std::size_t(target)] = number;
    if (number == nobody)
      point = input.frame.back(reply.points[i]);
    else
      point = std::size_t(number) < boundary ? surface.points[std::size_t(number)]
                                             : samples[std::size_t(number) - boundary];
  }
  result.tets.resize(reply.tets.size());
  for (std::size_t i = 0; i < reply.tets.size(); i++)
    for (std::size_t k = 0; k < 4; k++) result.tets[i][k] = numbering.renumbered(reply.tets[i][k]);
}

void count_points(const Surface &surface, Span<const Vec3> samples, RemeshResult &result) {
  const auto steiner = std::count(result.origin.begin(), result.origin.end(), nobody);
  const auto used = std::int64_t(result.points.size() - surface.points.size()) - steiner;
  result.report.steiner_points = steiner;
  result.report.dropped_samples = std::int64_t(samples.size()) - used;
}

std::string check_geometry(const Surface &surface, RemeshResult &result, const Frame &frame, double fraction,
                           Job &job) {
  Array<Vec3> points(result.points.size(), &job.memory);
  for (std::size_t i = 0; i < points.size(); i++) points[i] = frame.unit(result.points[i]);
  const std::string wrong = make_all_positive(points, {result.tets.data(), result.tets.size()}, fraction, job);
  return wrong.empty() ? check_volume(points, result.tets, surface.triangles, fraction, job) : wrong;
}

}  // namespace

std::string accept_reply(const RemeshInput &input, const Surface &surface, Span<const Vec3> samples, TetgenReply &reply,
                         double fraction, Job &job, RemeshResult &result) {
  if (reply.tets.empty()) return "no tets";
  if (!points_unchanged(input, reply)) return "points were moved";
  wind_positively(reply, fraction, job);
  std::string wrong = remove_cavities(input, reply, fraction, job);
  if (wrong.empty()) wrong = check_faces(input, reply, fraction, job);
  if (!wrong.empty()) return wrong;
  const Numbering numbering(input, reply, surface.points.size() + samples.size(), job);
  wrong = check_surface_used(numbering, surface);
  if (!wrong.empty()) return wrong;
  RemeshResult made(job.memory);
  fill_result(input, surface, samples, reply, numbering, made);
  wrong = check_geometry(surface, made, input.frame, fraction, job);
  if (!wrong.empty()) return wrong;
  count_points(surface, samples, made);
  result.points.swap(made.points);
  result.tets.swap(made.tets);
  result.origin.swap(made.origin);
  result.report.steiner_points = made.report.steiner_points;
  result.report.dropped_samples = made.report.dropped_samples;
  return {};
}

}  // namespace tetlod

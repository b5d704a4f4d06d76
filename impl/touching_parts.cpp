#include "touching_parts.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "conforming.hpp"
#include "face_sweep.hpp"
#include "field_jumps.hpp"
#include "folded_back.hpp"
#include "torn_sets.hpp"

namespace tetlod {

namespace {

class TouchingParts {
 public:
  TouchingParts(const SubmittedMesh &mesh, Job &job, Array<std::int32_t> &representative)
      : mesh_(mesh), job_(job), representative_(representative), kept_(job.memory), parts_(mesh.join_parts(job)) {}

  KeptApart keep_apart() {
    if (any_apart()) {
      NumberedTets tets = tets_by_place();
      number_parts(tets);
      find_torn(tets);
      const std::int64_t parts = parts_.count();
      join_across_faces(tets);
      if (find_ill_fitting(tets)) join_anew(tets);
      const bool are_of_one_mesh = parts_.count() < parts;  // not of an assembly, where some happen to fit
      if (are_of_one_mesh && any_apart() && can_conform(job_, tets)) {
        find_torn(tets);
        join_across_faces(tets);
      }
    }
    if (any_apart()) split_places();
    return std::move(kept_);
  }

 private:
  bool is_apart(std::size_t v) { return parts_.lowest(std::int32_t(v)) != parts_.lowest(representative_[v]); }

  bool any_apart() {
    for (std::size_t v = 0; v < representative_.size(); v++) {
      job_.poll_at(v, 0.9);
      if (is_apart(v)) return true;
    }
    return false;
  }

  /// By place, without those that are none; numbered as they are.
  NumberedTets tets_by_place() const {
    NumberedTets tets({mesh_.points, {}, {}}, {}, job_.memory);
    tets.tets.reserve(mesh_.tets.size());
    tets.number.reserve(mesh_.tets.size());
    for (std::size_t t = 0; t < mesh_.tets.size(); t++) {
      job_.poll_at(t, 0.9);
      Tet places = mesh_.tets[t];
      for (std::int32_t &v : places) v = representative_[std::size_t(v)];
      if (has_repeated_vertex(places) || !mesh_.has_all(mesh_.tets[t])) continue;
      tets.tets.push_back(places);
      tets.number.push_back(std::int32_t(t));
    }
    return tets;
  }

  /// visit(tet, other) of tets that have a face in common, as they were submitted.
  template <class Visit>
  void for_neighbours(const NumberedTets &tets, const Visit &visit) const {
    for_each_face(tets.view(), {}, job_, [&](const FaceUse *first, const FaceUse *last) {
      for (const FaceUse *use = first + 1; use < last; use++)
        visit(mesh_.tets[std::size_t(tets.number[first->tet()])], mesh_.tets[std::size_t(tets.number[use->tet()])]);
    });
  }

  void join_across_faces(const NumberedTets &tets) {
    TornSets sets(kept_.torn, parts_, job_.memory);
    for_neighbours(tets, [&](const Tet &t, const Tet &u) { sets.join(t[0], u[0]); });
  }

  /// Which parts, as submitted, a field jumps between; but not small ones, as the cells of a method that lets it jump.
  void find_torn(const NumberedTets &tets) {
    if (std::count_if(count_.begin(), count_.end(), [&](std::int32_t count) { return count >= large_part; }) < 2)
      return;
    FieldJumps fields(mesh_.input, mesh_.used, job_);
    Torn &torn = kept_.torn;
    for_neighbours(tets, [&](const Tet &t, const Tet &u) {
      if (may_be_torn(t, u) && is_torn(fields, t, u)) torn.push_back(pair_of(t, u));
    });
    sort_torn();
    Jumps asked = std::move(fields).asked();
    kept_.asked.insert(kept_.asked.end(), asked.begin(), asked.end());
  }

  /// Which of those that have a face in common lie on one another beside it, however gaps are closed. True: some do.
  /// After find_torn(), which asks for jumps where there are such parts.
  bool find_ill_fitting(const NumberedTets &tets) {
    if (kept_.asked.empty()) return false;
    NumberedTets closed(tets.view(), tets.number, job_.memory);
    if (!close_gaps_of(job_, closed)) return false;
    Torn &torn = kept_.torn;
    const std::size_t before = torn.size();
    const auto tet = [&](std::int32_t t) { return mesh_.tets[std::size_t(closed.number[std::size_t(t)])]; };
    for (const auto &[one, other] : find_folded_back(closed, job_)) {
      const Tet t = tet(one), u = tet(other);
      if (may_be_torn(t, u)) torn.push_back(pair_of(t, u));
    }
    sort_torn();
    return torn.size() > before;
  }

  void join_anew(const NumberedTets &tets) {
    parts_ = mesh_.join_parts(job_);
    join_across_faces(tets);
  }

  void sort_torn() {
    Torn &torn = kept_.torn;
    std::sort(torn.begin(), torn.end());
    torn.erase(std::unique(torn.begin(), torn.end()), torn.end());
  }

  /// As they were submitted, and how many tets each has.
  void number_parts(const NumberedTets &tets) {
    count_.resize(representative_.size(), 0);
    part_.resize(representative_.size());
    for (std::size_t v = 0; v < part_.size(); v++) {
      job_.poll_at(v, 0.9);
      part_[v] = parts_.lowest(std::int32_t(v));
    }
    for (std::size_t i = 0; i < tets.number.size(); i++) {
      job_.poll_at(i, 0.9);
      count_[std::size_t(part(mesh_.tets[std::size_t(tets.number[i])]))]++;
    }
  }

  bool may_be_torn(const Tet &t, const Tet &u) const {
    const auto is_large = [&](const Tet &of) { return count_[std::size_t(part(of))] >= large_part; };
    return part(t) != part(u) && is_large(t) && is_large(u);
  }
  std::int32_t part(const Tet &t) const { return part_[std::size_t(t[0])]; }
  std::pair<std::int32_t, std::int32_t> pair_of(const Tet &t, const Tet &u) const {
    return std::minmax({part(t), part(u)});
  }

  /// At a place that both have.
  bool is_torn(FieldJumps &fields, const Tet &t, const Tet &u) const {
    for (const std::int32_t v : t)
      for (const std::int32_t w : u)
        if (representative_[std::size_t(v)] == representative_[std::size_t(w)] && fields.ask(v, w)) return true;
    return false;
  }

  /// Where several parts are at one place, the lowest point of each stands for that part's.
  void split_places() {
    Array<std::uint8_t> shared(representative_.size(), 0, &job_.memory);
    for (std::size_t v = 0; v < shared.size(); v++) {
      job_.poll_at(v, 0.9);
      if (is_apart(v)) shared[std::size_t(representative_[v])] = 1;
    }
    struct OfPlace {
      std::int32_t place, part, point;
      bool operator<(const OfPlace &other) const {
        return std::tie(place, part, point) < std::tie(other.place, other.part, other.point);
      }
    };
    Array<OfPlace> points(&job_.memory);
    for (std::size_t v = 0; v < shared.size(); v++) {
      job_.poll_at(v, 0.9);
      const std::int32_t place = representative_[v], point = std::int32_t(v);
      if (shared[std::size_t(place)]) points.push_back({place, parts_.lowest(point), point});
    }
    std::sort(points.begin(), points.end(), PollingLess(job_, 0.9, std::less<OfPlace>()));
    for (std::size_t i = 0; i < points.size(); i++) {
      const bool goes_on = i > 0 && points[i].place == points[i - 1].place && points[i].part == points[i - 1].part;
      const std::int32_t lowest = goes_on ? representative_[std::size_t(points[i - 1].point)] : points[i].point;
      representative_[std::size_t(points[i].point)] = lowest;
    }
  }

  const SubmittedMesh &mesh_;
  Job &job_;
  Array<std::int32_t> &representative_;
  KeptApart kept_;
  DisjointSets parts_;                       // of the points
  Array<std::int32_t> part_{&job_.memory};   // of each, as submitted, known by its lowest point
  Array<std::int32_t> count_{&job_.memory};  // tets of each part
};

}  // namespace

KeptApart keep_touching_parts_apart(const SubmittedMesh &mesh, Job &job, Array<std::int32_t> &representative) {
  return TouchingParts(mesh, job, representative).keep_apart();
}

}  // namespace tetlod

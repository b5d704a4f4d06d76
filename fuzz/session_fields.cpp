// The fields beside the scalars and the flags of points: what a session submits of them, and what it finds in the
// answers.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <utility>

#include "demand.hpp"
#include "field_values.hpp"
#include "session.hpp"

namespace fuzz {

namespace {

constexpr const char *names[] = {"a", "b", "c", "\xc3\xa9"};

/// None, a corner of the mesh, anything; and rarely one that means nothing.
void fill_flags(Block &block, const Mesh &mesh, Bytes &in) {
  const std::size_t kind = in.below(8);
  const double edge = double(in.below(3));
  for (std::int64_t i = 0; i < block.layout().tuples; i++) {
    const bool there = i < mesh.point_count() && mesh.points[std::size_t(i)][0] <= edge;
    switch (kind) {
      case 0: block.set_integer(i, 0, 0); break;
      case 1:
      case 2: block.set_integer(i, 0, there ? TETLOD_FLAG_LOCK : 0); break;
      case 3: block.set_integer(i, 0, there ? TETLOD_FLAG_KEEP : 0); break;
      case 4: block.set_integer(i, 0, TETLOD_FLAG_LOCK); break;
      case 5: block.set_integer(i, 0, in.byte()); break;
      default: block.set_integer(i, 0, std::int64_t(in.below(4)));
    }
  }
}

/// Integers go to their own type or to 64 bits.
bool takes(const Block &room, const Block &values) {
  const std::int32_t type = room.layout().type;
  return !is_integer(values) || type == TETLOD_INT64 || type == values.layout().type;
}

bool same_bytes(const std::vector<double> &a, const std::vector<double> &b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace

// ---- Submitting ----------------------------------------------------------------------------------------------------

void Session::submit_field(Bytes &in) {
  const char *const name = in.one_in(16) ? "" : names[in.below(std::size(names))];
  const std::int32_t association = in.one_in(16) ? 2 : std::int32_t(in.below(2));
  const Block *const owner = association == TETLOD_CELL_FIELD ? tets_ : points_;
  const std::int64_t tuples = (owner ? owner->layout().tuples : 0) + in.one_in(16);
  blocks_.push_back(std::make_unique<Block>(any_numbers(tuples, any_components(in), in)));
  Block *const values = blocks_.back().get();
  fill_field(*values, in);
  const tetlod_array array = values->array();
  const tetlod_status status = tetlod_submit_field(context_, name, association, &array);
  const bool good = *name && association < 2;
  DEMAND(status == (good ? TETLOD_OK : TETLOD_ERR_ARGUMENT), "a field is taken in every layout: %d", status);
  if (!good && *name) withdraw(name);
  if (!good) return;
  trace("field %s of %s, %ld x %d\n", name, association ? "cells" : "points", long(tuples), array.components);
  forget_field(name);
  fields_.push_back({name, association, values});
}

bool Session::forget_field(const std::string &name) {
  const auto same_name = [&](const Field &field) { return field.name == name; };
  const auto end = std::remove_if(fields_.begin(), fields_.end(), same_name);
  const bool was_there = end != fields_.end();
  fields_.erase(end, fields_.end());
  return was_there;
}

void Session::withdraw(const std::string &name) {
  const tetlod_status expected = forget_field(name) ? TETLOD_OK : TETLOD_ERR_ARGUMENT;
  const tetlod_status status = tetlod_withdraw_field(context_, name.c_str());
  DEMAND(status == expected, "a field that is there is withdrawn, no other: %d", status);
  trace("field %s withdrawn: %d\n", name.c_str(), status);
}

void Session::submit_steering(Bytes &in) {
  constexpr double weights[] = {0, 1, 1e-3, 1e6, 2e6, -1, std::numeric_limits<double>::quiet_NaN()};
  const std::string name = in.one_in(16) ? "" : names[in.below(std::size(names))];
  const double weight = in.one_in(4) ? weights[in.below(std::size(weights))] : 1 + double(in.below(4));
  const std::int64_t tuples = (points_ ? points_->layout().tuples : 0) + in.one_in(32);
  blocks_.push_back(std::make_unique<Block>(any_reals(tuples, 1, in)));
  Block *const values = blocks_.back().get();
  fill_field(*values, in);
  const tetlod_array array = values->array();
  const tetlod_status status = tetlod_submit_steering(context_, name.c_str(), weight, &array);
  const auto same_name = [&](const Field &field) { return field.name == name; };
  const auto others = std::count_if(fields_.begin(), fields_.end(),
                                    [&](const Field &field) { return field.weight > 0 && !same_name(field); });
  const bool good = !name.empty() && weight >= 0 && weight <= 1e6 && (weight == 0 || others < 3);
  DEMAND(status == (good ? TETLOD_OK : TETLOD_ERR_ARGUMENT), "a field that steers is taken: %d", status);
  if (!good) return;
  trace("field %s steers with weight %g\n", name.c_str(), weight);
  forget_field(name);
  fields_.push_back({name, TETLOD_POINT_FIELD, values, weight});
}

void Session::submit_flags(Bytes &in) {
  const std::int64_t tuples = (points_ ? points_->layout().tuples : 0) + in.one_in(16);
  blocks_.push_back(std::make_unique<Block>(any_layout(TETLOD_UINT8, tuples, 1, in)));
  flags_ = blocks_.back().get();
  fill_flags(*flags_, mesh(), in);
  const tetlod_array array = flags_->array();
  const tetlod_status status = tetlod_submit_point_flags(context_, &array);
  DEMAND(status == TETLOD_OK, "flags are taken in every layout: %d", status);
  for (std::int64_t i = 0; i < tuples; i++) trace("flags %ld: %ld\n", long(i), long(flags_->integer(i, 0)));
}

bool Session::fields_fit() const {
  return std::all_of(fields_.begin(), fields_.end(), [this](const Field &field) {
    const Block *const owner = field.association == TETLOD_CELL_FIELD ? tets_ : points_;
    return owner && field.values->layout().tuples == owner->layout().tuples;
  });
}

bool Session::flags_fit() const {
  if (!flags_) return true;
  for (std::int64_t i = 0; i < flags_->layout().tuples; i++)
    if (flags_->integer(i, 0) > 3) return false;
  return points_ && flags_->layout().tuples == points_->layout().tuples;
}

// ---- What a run made of them ---------------------------------------------------------------------------------------

std::vector<double> Session::carried(const Field &field) const {
  const bool of_cells = field.association == TETLOD_CELL_FIELD;
  const auto tuples = std::int64_t(of_cells ? last_->tets.size() : last_->points.size());
  Block block(packed(wide_type(*field.values), tuples, field.values->layout().components));
  tetlod_array array = block.array();
  const tetlod_status status = tetlod_fetch_field(context_, field.name.c_str(), &array);
  DEMAND(status == TETLOD_OK, "a field that rode along can be fetched: %d", status);
  return values_of(block);
}

void Session::check_carried_kept() const {
  for (const Carried &field : carried_)
    DEMAND(same_bytes(carried(field.field), field.values), "field %s stays as it was", field.field.name.c_str());
}

Stencil Session::stencil() const {
  const auto points = std::int64_t(last_->points.size());
  Block ids(packed(TETLOD_INT64, points, 4)), weights(packed(TETLOD_FLOAT64, points, 4));
  tetlod_array to_ids = ids.array(), to_weights = weights.array();
  const tetlod_status status = tetlod_fetch_stencil(context_, 0, &to_ids, &to_weights);
  DEMAND(status == TETLOD_OK, "the stencil can be fetched: %d", status);
  Stencil stencil;
  for (std::int64_t i = 0; i < points; i++) {
    stencil.ids.push_back({ids.integer(i, 0), ids.integer(i, 1), ids.integer(i, 2), ids.integer(i, 3)});
    stencil.weights.push_back({weights.real(i, 0), weights.real(i, 1), weights.real(i, 2), weights.real(i, 3)});
  }
  return stencil;
}

/// Where the mesh is sound an original vertex is itself.
void Session::check_stencil(const Mesh &mesh, const Stencil &stencil) const {
  std::set<Point> original;
  if (mesh.sound && option(TETLOD_OPT_MERGE_TOLERANCE) == 0)
    for (const Corners &tet : mesh.tets)
      for (const std::int64_t v : tet) original.insert(mesh.points[std::size_t(v)]);
  for (std::size_t i = 0; i < stencil.ids.size(); i++) {
    const auto &ids = stencil.ids[i];
    const auto &weights = stencil.weights[i];
    double sum = 0;
    for (std::size_t k = 0; k < 4; k++) {
      DEMAND(ids[k] >= 0 && ids[k] < mesh.point_count(), "vertex %zu: id %ld is a point", i, long(ids[k]));
      DEMAND(weights[k] >= 0 && weights[k] <= 1, "vertex %zu: a weight is %g", i, weights[k]);
      sum += weights[k];
    }
    DEMAND(std::abs(sum - 1) < 1e-12, "vertex %zu: the weights add up to %.17g", i, sum);
    if (!original.count(last_->points[i])) continue;
    DEMAND(weights[0] == 1 && mesh.points[std::size_t(ids[0])] == last_->points[i],
           "vertex %zu is original vertex %ld with the weight %.17g", i, long(ids[0]), weights[0]);
  }
}

void Session::check_point_field(const Stencil &stencil, const Carried &carried) const {
  const Block &original = *carried.field.values;
  const std::int32_t components = original.layout().components;
  Block again(packed(wide_type(original), std::int64_t(stencil.ids.size()), components));
  const tetlod_array from = original.array();
  tetlod_array to = again.array();
  const tetlod_status status = tetlod_transfer(context_, &from, &to);
  DEMAND(status == TETLOD_OK, "a field that rode along can be moved: %d", status);
  DEMAND(same_bytes(values_of(again), carried.values), "tetlod_transfer gives the bytes of field %s",
         carried.field.name.c_str());
  for (std::size_t i = 0; i < stencil.ids.size(); i++)
    for (std::int32_t c = 0; c < components; c++)
      check_moved(stencil, i, c, carried.values[i * std::size_t(components) + std::size_t(c)], original);
}

/// All fields of a tet are those of one original tet.
void Session::check_cell_fields() const {
  if (carried_.empty() || !tets_) return;
  const auto comes_from = [&](std::size_t t, std::int64_t source) {
    for (const Carried &field : carried_) {
      if (field.field.association != TETLOD_CELL_FIELD) continue;
      const std::int32_t components = field.field.values->layout().components;
      for (std::int32_t c = 0; c < components; c++)
        if (!same_or_both_nan(field.values[t * std::size_t(components) + std::size_t(c)],
                              value_of(*field.field.values, source, c)))
          return false;
    }
    return true;
  };
  for (std::size_t t = 0; t < last_->tets.size(); t++) {
    std::int64_t source = 0;
    while (source < tets_->layout().tuples && !comes_from(t, source)) source++;
    DEMAND(source < tets_->layout().tuples, "tet %zu has the values of an original tet", t);
  }
}

/// After a run that succeeded.
void Session::accept_fields(const Mesh &mesh) {
  carried_.clear();
  for (const Field &field : fields_) carried_.push_back({field, carried(field)});
  last_points_ = points_, last_tets_ = tets_, last_values_ = values_, last_base_ = base_;
  last_steering_ = steering();
  const auto of_points = [](const Field &f) { return f.association == TETLOD_POINT_FIELD && f.weight == 0; };
  for (const Carried &field : carried_)
    if (field.field.weight > 0) check_steered(field);
  stencil_known_ = std::any_of(fields_.begin(), fields_.end(), of_points);
  check_cell_fields();
  if (!stencil_known_ || conditions_.memory_limit) return;
  const Stencil means = stencil();
  check_stencil(mesh, means);
  for (const Carried &field : carried_)
    if (of_points(field.field)) check_point_field(means, field);
}

/// Flagged vertices of the boundary are there, with their values, and so are triangles between locked ones.
void Session::check_flags(const Mesh &mesh, const Facts &facts) const {
  if (!flags_ || facts.coincident) return;
  std::set<std::pair<Point, double>> there;
  for (std::size_t i = 0; i < last_->points.size(); i++) there.emplace(last_->points[i], last_->values[i]);
  std::set<std::set<Point>> triangles;
  for (const Face &face : last_->boundary) {
    std::set<Point> corners;
    for (const std::int64_t v : face) corners.insert(last_->points[std::size_t(v)]);
    triangles.insert(corners);
  }
  for (const Face &face : facts.boundary) {
    std::set<Point> corners;
    bool locked = true;
    for (const std::int64_t v : face) {
      const Point &p = mesh.points[std::size_t(v)];
      const std::int64_t flags = flags_->integer(v, 0);
      if (flags) DEMAND(there.count({p, mesh.values[std::size_t(v)]}), "flagged vertex %ld survives", long(v));
      locked = locked && (flags & TETLOD_FLAG_LOCK);
      corners.insert(p);
    }
    if (locked) DEMAND(triangles.count(corners), "a triangle between locked vertices stays");
  }
}

// ---- Asking --------------------------------------------------------------------------------------------------------

/// Under its name and with its components, or not.
void Session::fetch_field(Bytes &in) {
  const char *const name = in.one_in(16) ? "" : names[in.below(std::size(names))];
  const auto found =
      std::find_if(carried_.begin(), carried_.end(), [&](const Carried &field) { return field.field.name == name; });
  const bool known = last_ && found != carried_.end();
  const std::int32_t right = known ? found->field.values->layout().components : 1;
  const std::int32_t components = in.one_in(8) ? any_components(in) : right;
  const std::int64_t tuples = known ? std::int64_t(found->values.size()) / right : 0;
  const std::int64_t room = std::max<std::int64_t>(0, tuples + in.between(-1, 3));
  Block block(known ? any_room_for(*found->field.values, room, components, in) : any_reals(room, components, in));
  const bool takes_them = !known || takes(block, *found->field.values);
  tetlod_array array = block.array();
  const tetlod_status status = tetlod_fetch_field(context_, name, &array);
  const tetlod_status wanted = !*name                          ? TETLOD_ERR_ARGUMENT
                               : !last_                        ? TETLOD_ERR_STATE
                               : !known || components != right ? TETLOD_ERR_ARGUMENT
                               : room < tuples                 ? TETLOD_ERR_BUFFER_SIZE
                               : !takes_them                   ? TETLOD_ERR_ARGUMENT
                                                               : TETLOD_OK;
  DEMAND(status == wanted, "field %s x %d into %ld tuples: %d, not %d", name, components, long(room), status, wanted);
  DEMAND(block.rest_untouched(status == TETLOD_OK ? tuples : 0), "only the tuples of the result are written");
  for (std::int64_t i = 0; i < tuples && status == TETLOD_OK; i++)
    for (std::int32_t c = 0; c < right; c++) {
      const double value = found->values[std::size_t(i * right + c)];
      const double rounded = array.type == TETLOD_FLOAT32 ? double(float(value)) : value;
      DEMAND(same_or_both_nan(value_of(block, i, c), rounded), "element %ld %d is fetched", long(i), c);
    }
}

/// Known, or found now in the mesh of the run, if that is still submitted.
tetlod_status Session::stencil_status() const {
  if (stencil_known_) return TETLOD_OK;
  const bool same_mesh = points_ == last_points_ && tets_ == last_tets_ && base_ == last_base_;
  return complete() && same_mesh ? TETLOD_OK : TETLOD_ERR_STATE;
}

bool Session::explains_limit(tetlod_status status) const {
  return status == TETLOD_ERR_MEMORY_LIMIT && conditions_.memory_limit;
}

/// Values of a later step are read with the mesh: they may be too few, refused, or others may be ignored.
bool Session::explains_refusal(tetlod_status status) const {
  const bool same_values = values_ == last_values_ && steering() == last_steering_;
  return complete() && !stencil_known_ && !same_values &&
         (status == TETLOD_ERR_ARGUMENT || status == TETLOD_ERR_STATE || status == TETLOD_ERR_MESH_NONFINITE);
}

void Session::fetch_stencil(Bytes &in) {
  const std::int64_t points = last_ ? std::int64_t(last_->points.size()) : 0;
  const std::int64_t room = std::max<std::int64_t>(0, points + in.between(-1, 3));
  const std::int32_t type = any_integer(in);
  Block ids(any_layout(type, room, 4, in)), weights(any_reals(room, 4, in));
  const auto base = std::int32_t(in.below(2));
  tetlod_array to_ids = ids.array(), to_weights = weights.array();
  const tetlod_status status = tetlod_fetch_stencil(context_, base, &to_ids, &to_weights);
  const tetlod_status wanted = !last_ ? TETLOD_ERR_STATE : room < points ? TETLOD_ERR_BUFFER_SIZE : stencil_status();
  DEMAND(status == wanted || explains_limit(status) || explains_refusal(status), "the stencil: %d, not %d: %s", status,
         wanted, message().c_str());
  const std::int64_t written = status == TETLOD_OK ? points : 0;
  DEMAND(ids.rest_untouched(written) && weights.rest_untouched(written), "only the stencil is written");
  if (status != TETLOD_OK) return;
  stencil_was_found();
  const Stencil means = stencil();
  for (std::int64_t i = 0; i < points; i++)
    for (std::int32_t k = 0; k < 4; k++) {
      const auto vertex = std::size_t(i), corner = std::size_t(k);
      DEMAND(ids.integer(i, k) == means.ids[vertex][corner] + base, "id %ld %d is fetched", long(i), k);
      const double weight = means.weights[vertex][corner];
      const double rounded = to_weights.type == TETLOD_FLOAT64 ? weight : double(float(weight));
      DEMAND(weights.real(i, k) == rounded, "weight %ld %d is fetched", long(i), k);
    }
}

/// A field that did not ride along.
void Session::transfer(Bytes &in) {
  const std::int64_t points = last_ ? std::int64_t(last_->points.size()) : 0;
  const std::int64_t points_in = (last_ ? last_points_->layout().tuples : 3) + in.one_in(16);
  const std::int32_t components = any_components(in);
  Block original(any_numbers(points_in, components, in));
  fill_field(original, in);
  const std::int64_t room = std::max<std::int64_t>(0, points + in.between(-1, 3));
  const std::int32_t components_out = components + in.one_in(16);
  Block simplified(any_room_for(original, room, components_out, in));
  const tetlod_array from = original.array();
  tetlod_array to = simplified.array();
  const tetlod_status status = tetlod_transfer(context_, &from, &to);
  const bool fits =
      to.components == components && takes(simplified, original) && last_ && points_in == last_points_->layout().tuples;
  const tetlod_status wanted = !last_               ? TETLOD_ERR_STATE
                               : to.components > 64 ? TETLOD_ERR_ARGUMENT
                               : room < points      ? TETLOD_ERR_BUFFER_SIZE
                               : !fits              ? TETLOD_ERR_ARGUMENT
                                                    : stencil_status();
  DEMAND(status == wanted || explains_limit(status) || explains_refusal(status), "moving a field: %d, not %d: %s",
         status, wanted, message().c_str());
  DEMAND(simplified.rest_untouched(status == TETLOD_OK ? points : 0), "only the tuples of the result are written");
  if (status == TETLOD_OK) stencil_was_found();
  if (status != TETLOD_OK || conditions_.memory_limit) return;
  if (to.type == TETLOD_FLOAT32) return;
  const Stencil means = stencil();
  for (std::size_t i = 0; i < means.ids.size(); i++)
    for (std::int32_t c = 0; c < components; c++)
      check_moved(means, i, c, value_of(simplified, std::int64_t(i), c), original);
}

}  // namespace fuzz

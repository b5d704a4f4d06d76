// The fields that ride along: submitting them, fetching what became of them, and moving any other afterwards.
#include <algorithm>
#include <cinttypes>

#include "arguments.hpp"
#include "carry_fields.hpp"
#include "context.hpp"
#include "transfer.hpp"
#include "work.hpp"
#include "write_array.hpp"

namespace tetlod::capi {

namespace {

static_assert(std::int32_t(Association::point) == TETLOD_POINT_FIELD, "");
static_assert(std::int32_t(Association::cell) == TETLOD_CELL_FIELD, "");

void require_name(const char *name) {
  require_pointer(name, "name");
  if (!*name) fail(Status::argument, "name is empty");
}

void require_association(std::int32_t association) {
  if (association != TETLOD_POINT_FIELD && association != TETLOD_CELL_FIELD)
    fail(Status::argument, "association %d is neither TETLOD_POINT_FIELD (0) nor TETLOD_CELL_FIELD (1)", association);
}

/// How messages speak of a field.
std::string field_text(const char *name) { return text("field %.100s", name); }

/// The field of that name, or where a new one goes.
template <class Field>
Field &slot_of(const std::string &name, std::vector<Field> &fields) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field &field) { return field.name == name; });
  return found != fields.end() ? *found : fields.emplace_back();
}

/// A name is one field: where it is another's, that one goes, and this is true. Cannot fail.
template <class Field>
bool forget(const std::string &name, std::vector<Field> &fields) {
  const auto end = std::remove_if(fields.begin(), fields.end(), [&](const Field &field) { return field.name == name; });
  const bool was_there = end != fields.end();
  fields.erase(end, fields.end());
  return was_there;
}

template <class Field>
std::string names_of(const std::vector<Field> &fields) {
  std::string names;
  for (const Field &field : fields) names += (names.empty() ? "" : ", ") + field.name;
  return names.empty() ? "none" : names;
}

const CarriedField &carried_field(const Result &result, const char *name) {
  for (const CarriedField &field : result.fields)
    if (field.name == name) return field;
  fail(Status::argument, "the last run carried no field %.100s, but %.400s", name, names_of(result.fields).c_str());
}

/// Of the last result; found now, if it has not been needed before: in the mesh, whatever its values are by now.
const Stencil &stencil_of(tetlod_context &context) {
  Outcome &outcome = last_outcome(context);
  if (outcome.result.stencil.ids.empty()) {
    require_submitted(context.input);
    Input original = context.input;
    original.fields.clear();
    begin(context);
    Job job = quiet_job_of(context);
    ahead_of_what_is_kept(context,
                          [&] { find_stencil(original, outcome.options, context.prepared, job, outcome.result); });
  }
  return outcome.result.stencil;
}

void require_weight(const char *name, double weight) {
  constexpr double most = 1e6;
  if (!(weight >= 0 && weight <= most))
    fail(Status::argument, "field %.100s: weight %s is not in [0, %s]", name, number(weight).c_str(),
         number(most).c_str());
}

void require_not_the_scalars(const tetlod_context &context, const char *name) {
  if (context.input.scalars.present && context.input.scalars_name == name)
    fail(Status::argument, "field %.100s: the scalars have this name", name);
}

void require_room(const std::string &name, const std::vector<SteeringField> &fields) {
  const auto others =
      std::count_if(fields.begin(), fields.end(), [&](const SteeringField &field) { return field.name != name; });
  if (others + 1 >= std::ptrdiff_t(most_fields))
    fail(Status::argument, "field %.100s: %zu fields beside the scalars steer at most, and there are %.400s",
         name.c_str(), most_fields - 1, names_of(fields).c_str());
}

/// It takes the place of the one that had its name, among those that steer and those that ride along.
void put(SubmittedField &&field, Input &input) {
  input.fields.reserve(input.fields.size() + 1);
  forget(field.name, input.steering);
  slot_of(field.name, input.fields) = std::move(field);
}

void put(SteeringField &&field, Input &input) {
  require_room(field.name, input.steering);
  input.steering.reserve(input.steering.size() + 1);
  forget(field.name, input.fields);
  slot_of(field.name, input.steering) = std::move(field);
  const auto is_before = [](const SteeringField &a, const SteeringField &b) { return a.name < b.name; };
  std::sort(input.steering.begin(), input.steering.end(), is_before);  // it is no matter which came first
}

/// For values of that type: reals go to either of theirs, integers to their own or to one that has them all.
StridedArray checked_room(const tetlod_array *array, ElementType from, const char *name, int components,
                          std::size_t tuples) {
  const Shape shape{name, components, is_integer(from) ? Shape::numbers : Shape::reals};
  const StridedArray to = checked_destination(array, shape, tuples);
  if (is_integer(from) && to.type != from && to.type != ElementType::int64)
    fail(Status::argument, "%s: type %d cannot take integers of type %d; that or TETLOD_INT64 (2) can", name,
         int(to.type), int(from));
  return to;
}

void require_same_components(const StridedArray &original, const StridedArray &simplified) {
  if (original.components != simplified.components)
    fail(Status::argument, "original has %d components, simplified %d", original.components, simplified.components);
}

}  // namespace

}  // namespace tetlod::capi

using namespace tetlod;
using namespace tetlod::capi;

tetlod_status tetlod_submit_field(tetlod_context *handle, const char *name, int32_t association,
                                  const tetlod_array *values) {
  return entry(handle, [&](tetlod_context &context) {
    require_name(name);
    require_association(association);
    const std::string called = field_text(name);
    SubmittedField field;
    field.values = checked_source(values, {called.c_str(), Shape::any_number, Shape::numbers});
    field.association = Association(association);
    field.name = name;
    put(std::move(field), context.input);
  });
}

tetlod_status tetlod_submit_steering(tetlod_context *handle, const char *name, double weight,
                                     const tetlod_array *values) {
  return entry(handle, [&](tetlod_context &context) {
    require_name(name);
    require_weight(name, weight);
    require_not_the_scalars(context, name);
    const StridedArray checked = checked_source(values, {field_text(name).c_str(), 1, Shape::reals});
    if (weight > 0)
      put(SteeringField{name, weight, checked}, context.input);
    else
      put(SubmittedField{name, Association::point, checked}, context.input);
  });
}

tetlod_status tetlod_withdraw_field(tetlod_context *handle, const char *name) {
  return entry(handle, [&](tetlod_context &context) {
    require_name(name);
    Input &input = context.input;
    if (!forget(name, input.fields) && !forget(name, input.steering))
      fail(Status::argument, "field %.100s is not submitted, but to ride along %.200s, to steer %.200s", name,
           names_of(input.fields).c_str(), names_of(input.steering).c_str());
  });
}

tetlod_status tetlod_fetch_field(const tetlod_context *handle, const char *name, tetlod_array *dst) {
  return entry(handle, [&](const tetlod_context &context) {
    require_name(name);
    const Result &result = last_outcome(context).result;
    const CarriedField &field = carried_field(result, name);
    const bool of_cells = field.association == Association::cell;
    const std::size_t tuples = of_cells ? result.mesh.tets.size() : result.mesh.points.size();
    const std::string called = field_text(name);
    const StridedArray to = checked_room(dst, field.type, called.c_str(), field.components, tuples);
    const auto place = [&](std::size_t i, int c) { return i * std::size_t(field.components) + std::size_t(c); };
    if (is_integer(field.type))
      write(to, tuples, [&](std::size_t i, int c) { return field.integers[place(i, c)]; });
    else
      write(to, tuples, [&](std::size_t i, int c) { return field.values[place(i, c)]; });
  });
}

tetlod_status tetlod_fetch_stencil(const tetlod_context *handle, int32_t index_base, tetlod_array *ids,
                                   tetlod_array *weights) {
  return entry(handle, [&](tetlod_context &context) {
    require_index_base(index_base);
    const std::size_t points = last_outcome(context).result.mesh.points.size();
    StridedArray to_ids = checked_destination(ids, {"ids", 4, Shape::integers}, points);
    StridedArray to_weights = checked_destination(weights, {"weights", 4, Shape::reals}, points);
    to_ids.tuples = to_weights.tuples = std::int64_t(points);
    require_memory_of_its_own(to_weights, "weights", to_ids, "ids");
    const Stencil &stencil = stencil_of(context);
    write(to_ids, points, [&](std::size_t i, int c) { return stencil.ids[i][std::size_t(c)] + index_base; });
    write(to_weights, points, [&](std::size_t i, int c) { return stencil.weights[i][std::size_t(c)]; });
  });
}

tetlod_status tetlod_transfer(tetlod_context *handle, const tetlod_array *original, tetlod_array *simplified) {
  return entry(handle, [&](tetlod_context &context) {
    const Result &result = last_outcome(context).result;
    const StridedArray from = checked_source(original, {"original", Shape::any_number, Shape::numbers});
    const StridedArray to =
        checked_room(simplified, from.type, "simplified", Shape::any_number, result.mesh.points.size());
    require_same_components(from, to);
    if (from.tuples != result.report.points_in)
      fail(Status::argument, "original: %" PRId64 " tuples, the original mesh has %" PRId64 " points", from.tuples,
           result.report.points_in);
    StridedArray written = to;
    written.tuples = std::int64_t(result.mesh.points.size());
    require_memory_of_its_own(written, "simplified", from, "original");
    const Stencil &stencil = stencil_of(context);
    begin(context);
    Job job(context.memory, context.parallel);  // not one that can be cancelled: half a field is none
    transfer(stencil, from, to, job);
  });
}

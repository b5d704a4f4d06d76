// The whole C ABI, in any order, with a host that cancels, throws, and has no more memory.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <string>

#include "demand.hpp"
#include "session.hpp"

namespace fuzz {

namespace {

constexpr int most_steps = 8;

// ---- Without a context ---------------------------------------------------------------------------------------------

void ask_texts(Session &, Bytes &in) {
  std::int32_t major = -1;
  tetlod_version(&major, nullptr, nullptr);
  DEMAND(major == TETLOD_VERSION_MAJOR, "the library is of the header's version");
  DEMAND(tetlod_build_info() && tetlod_status_text(in.raw<std::int32_t>()), "texts are there");
  DEMAND(tetlod_stage_name(in.raw<std::int32_t>()), "a stage's name is there");
  const std::int32_t option = decode_option(in);
  const char *const name = tetlod_option_name(option);
  if (name) DEMAND(tetlod_option_from_name(name) == option, "an option is known by its name");
  std::string garbled(in.below(16), ' ');
  for (char &letter : garbled) letter = char(in.byte());
  const std::int32_t found = tetlod_option_from_name(garbled.c_str());
  DEMAND(found == 0 || std::strcmp(tetlod_option_name(found), garbled.c_str()) == 0, "an option has the name");
}

/// Outputs that no failure may touch.
struct Untouched {
  tetlod_array array;
  tetlod_run_report run;
  tetlod_error_report error;
  tetlod_mesh_report mesh;
  tetlod_bounds bounds;
  double real;
  std::int64_t integer;
  std::uint64_t bytes;
  tetlod_context *context;
};

/// Every function, with no context or without its pointers.
void call_with_nothing(Session &session, Bytes &in) {
  Untouched out, before;
  std::memset(&out, int(in.byte()), sizeof out);
  std::memcpy(&before, &out, sizeof out);
  tetlod_context *const c = in.one_in(2) ? session.context() : nullptr;
  const bool bare = c == nullptr;
  tetlod_array *const array = bare ? &out.array : nullptr;
  const tetlod_status statuses[] = {
      tetlod_create(nullptr, nullptr),
      tetlod_set_log(nullptr, nullptr, nullptr, 0),
      tetlod_set_progress(nullptr, nullptr, nullptr),
      tetlod_set_rho(nullptr, 0.5),
      tetlod_set_sigma(nullptr, 0.5),
      tetlod_set_lambda(nullptr, 0.5),
      tetlod_set_min_distance(nullptr, 0.5),
      tetlod_set_preset(nullptr, 0),
      tetlod_set_real(nullptr, 1, 0.5),
      tetlod_set_int(nullptr, 7, 5),
      tetlod_get_real(c, 1, bare ? &out.real : nullptr),
      tetlod_get_int(c, 7, bare ? &out.integer : nullptr),
      tetlod_option_bounds(1, nullptr),
      tetlod_submit_points(c, nullptr),
      tetlod_submit_points_xyz(c, nullptr, nullptr, nullptr),
      tetlod_submit_tets(c, nullptr, 0),
      tetlod_submit_scalars(c, nullptr, nullptr),
      tetlod_submit_field(c, "f", TETLOD_POINT_FIELD, nullptr),
      tetlod_submit_steering(c, "f", 1, nullptr),
      tetlod_submit_point_flags(c, nullptr),
      tetlod_clear(nullptr),
      tetlod_check(c, bare ? &out.mesh : nullptr),
      tetlod_estimate_memory(c, bare ? &out.bytes : nullptr),
      tetlod_run(nullptr),
      tetlod_measure_error(c, 0, bare ? &out.error : nullptr),
      tetlod_histogram(c, 1, 1, bare ? &out.integer : nullptr),
      tetlod_fetch_counts(nullptr, &out.integer, nullptr, nullptr),
  };
  for (const tetlod_status status : statuses) DEMAND(status == TETLOD_ERR_ARGUMENT, "null pointers: %d", status);
  const tetlod_status later[] = {tetlod_fetch_points(c, array),
                                 tetlod_fetch_tets(c, 0, array),
                                 tetlod_fetch_boundary(c, 0, array),
                                 tetlod_fetch_scalars(c, array),
                                 tetlod_fetch_field(c, "f", array),
                                 tetlod_fetch_stencil(c, 0, array, array),
                                 tetlod_transfer(c, array, array),
                                 tetlod_view_points(c, array),
                                 tetlod_view_tets(c, array),
                                 tetlod_view_scalars(c, array),
                                 tetlod_fetch_report(c, bare ? &out.run : nullptr)};
  for (const tetlod_status status : later)
    DEMAND(status == TETLOD_ERR_ARGUMENT || (!session.has_result() && status == TETLOD_ERR_STATE),
           "null pointers of a result: %d", status);
  DEMAND(std::memcmp(&out, &before, sizeof out) == 0, "a failure leaves every output as it was");
  tetlod_cancel(nullptr);
  tetlod_destroy(nullptr);
}

void make_wrong_context(Session &, Bytes &in) {
  tetlod_config config{};
  config.struct_size = in.one_in(2) ? std::uint32_t(sizeof config) : in.raw<std::uint32_t>() % 200;
  config.api_version = in.one_in(2) ? TETLOD_API_VERSION : in.raw<std::uint32_t>();
  config.remesher = in.one_in(2) ? "" : nullptr;
  if (in.one_in(2)) config.release = [](void *, void *, std::size_t, std::size_t) {};
  struct {
    tetlod_config config;
    unsigned char newer[200] = {};
  } padded{config, {}};
  tetlod_context *made = nullptr;
  const tetlod_status status = tetlod_create(&padded.config, &made);
  check_documented("tetlod_create", status, {TETLOD_ERR_STRUCT_SIZE});
  DEMAND((status == TETLOD_OK) == (made != nullptr), "a context is made on success alone");
  tetlod_destroy(made);
}

// ---- Options -------------------------------------------------------------------------------------------------------

void set_option(Session &session, Bytes &in) {
  const std::int32_t option = decode_option(in);
  tetlod_bounds bounds{};
  bounds.struct_size = sizeof bounds;
  const bool known = tetlod_option_bounds(option, &bounds) == TETLOD_OK;
  DEMAND(known == (tetlod_option_name(option) != nullptr), "an option has a name and bounds, or neither");
  Setting setting = decode_value(option, {bounds.is_integer != 0, bounds.least, bounds.most, bounds.preset}, in);
  if (option == TETLOD_OPT_THREADS && setting.integer > 0) setting.integer = 1 + setting.integer % 2;
  session.set(setting);
}

void set_by_name(Session &session, Bytes &in) {
  const double value = in.real();
  struct Named {
    tetlod_status (*set)(tetlod_context *, double);
    std::int32_t option;
  };
  constexpr Named all[] = {{tetlod_set_rho, TETLOD_OPT_RHO},
                           {tetlod_set_sigma, TETLOD_OPT_SIGMA},
                           {tetlod_set_lambda, TETLOD_OPT_LAMBDA},
                           {tetlod_set_min_distance, TETLOD_OPT_MIN_DISTANCE}};
  const Named &named = all[in.below(std::size(all))];
  const double before = session.option(named.option);
  const tetlod_status status = named.set(session.context(), value);
  check_documented("tetlod_set_...", status, {TETLOD_ERR_OPTION});
  DEMAND(session.option(named.option) == (status == TETLOD_OK ? value : before),
         "an option has the value that was set");
}

void set_preset(Session &session, Bytes &in) {
  const std::int32_t preset = std::int32_t(in.byte() % 4) - 1;
  check_documented("tetlod_set_preset", tetlod_set_preset(session.context(), preset), {TETLOD_ERR_OPTION});
}

/// A size, a bound, both, or neither again.
void set_target(Session &session, Bytes &in) {
  const std::size_t kind = in.below(5);
  if (kind == 2) session.set({TETLOD_OPT_MAX_DEVIATION, in.fraction() * std::pow(10.0, -double(in.below(4))), 0});
  const std::size_t way = in.below(24);  // small meshes are remeshed only where edges are to be cleaned
  session.set({TETLOD_OPT_EFFORT, 0, way % 3 == 2 ? TETLOD_EFFORT_FAST : TETLOD_EFFORT_ACCURATE});
  session.set({TETLOD_OPT_CLEAN_EDGES, way % 3 == 2 ? 1e-15 : 0, 0});
  session.set({TETLOD_OPT_REMESH, 0, way < 21});
  session.set({TETLOD_OPT_TARGET_RATIO, kind == 0 ? 0 : in.fraction(), 0});
  session.set({TETLOD_OPT_MAX_ERROR, kind > 2 ? in.fraction() * std::pow(10.0, -double(in.below(5))) : 0, 0});
}

// ---- Input ---------------------------------------------------------------------------------------------------------

void submit_mesh(Session &session, Bytes &in) { session.submit_all(decode_mesh(in)); }

void submit_in_layouts(Session &session, Bytes &in) {
  const Mesh mesh = decode_mesh(in);
  session.submit_points(mesh, in);
  session.submit_tets(mesh, in);
  session.submit_values(mesh, in);
}

void submit_one_slot(Session &session, Bytes &in) {
  const Mesh mesh = decode_mesh(in);
  switch (in.below(3)) {
    case 0: session.submit_points(mesh, in); break;
    case 1: session.submit_tets(mesh, in); break;
    default: session.submit_values(mesh, in);
  }
}

void submit_field(Session &session, Bytes &in) { session.submit_field(in); }
void submit_steering(Session &session, Bytes &in) { session.submit_steering(in); }
void submit_flags(Session &session, Bytes &in) { session.submit_flags(in); }

void forget_input(Session &session, Bytes &) { session.clear(); }

// ---- Work ----------------------------------------------------------------------------------------------------------

void run(Session &session, Bytes &in) { session.run(decode_disturbance(in)); }
void check(Session &session, Bytes &in) { session.check(decode_disturbance(in)); }
void estimate(Session &session, Bytes &in) { session.estimate(decode_disturbance(in)); }

void cancel_nothing(Session &session, Bytes &) {
  tetlod_cancel(session.context());
  session.run({});
}

/// The same input another way gives the same bytes.
void run_another_way(Session &session, Bytes &in) {
  if (session.option(TETLOD_OPT_WARM_START) > 0) return;  // bytes then depend on the runs before
  if (!session.complete() || session.run({}) != TETLOD_OK) return;
  const std::uint64_t wanted = session.last_hash();
  const double threads = session.option(TETLOD_OPT_THREADS);
  const Mesh mesh = session.mesh();
  if (std::any_of(mesh.points.begin(), mesh.points.end(), [](const Point &p) { return std::isnan(p[0]); })) return;
  session.submit_points(mesh, in);
  session.submit_tets(mesh, in);
  session.submit_values(mesh, in);
  const Mesh now = session.mesh();
  if (now.points != mesh.points || now.values != mesh.values || now.tets != mesh.tets) return;  // rounded to floats
  tetlod_set_int(session.context(), TETLOD_OPT_THREADS, threads == 2 ? 1 : 2);
  const tetlod_status status = session.run({});
  DEMAND(status == TETLOD_OK, "another layout of the same mesh is the same mesh: %d", status);
  DEMAND(session.last_hash() == wanted, "the same input gives the same bytes");
  tetlod_set_int(session.context(), TETLOD_OPT_THREADS, std::int64_t(threads));
  if (in.one_in(2)) session.run_another_size_between(in.fraction());
}

void measure(Session &session, Bytes &in) {
  tetlod_error_report report;
  std::memset(&report, 0x5a, sizeof report);
  report.struct_size = sizeof report;
  const double before = report.rms;
  const auto samples = std::int32_t(in.between(-1, 8));
  const tetlod_status status = tetlod_measure_error(session.context(), samples, &report);
  check_documented("tetlod_measure_error", status, {TETLOD_ERR_STATE, TETLOD_ERR_MEMORY_LIMIT});
  if (status != TETLOD_OK) {
    DEMAND(std::memcmp(&before, &report.rms, sizeof before) == 0, "a failure writes nothing");
    return;
  }
  for (const double error : {report.rms, report.max, report.rms_inner, report.max_inner})
    DEMAND(error >= 0, "an error is a number: %g", error);
  for (const double share : {report.outside, report.outside_inner})
    DEMAND(share >= 0 && share <= 1, "a share is in [0, 1]: %g", share);
}

void count_values(Session &session, Bytes &in) {
  const auto bins = std::int32_t(in.between(-1, 40)), side = std::int32_t(in.between(-1, 2));
  std::vector<std::int64_t> counts(41, -5);
  const tetlod_status status = tetlod_histogram(session.context(), side, bins, counts.data());
  check_documented("tetlod_histogram", status, {TETLOD_ERR_STATE});
  std::int64_t sum = 0;
  for (std::size_t b = 0; b < counts.size(); b++) {
    const bool written = status == TETLOD_OK && std::int64_t(b) < bins;
    DEMAND(written == (counts[b] != -5) && counts[b] != -6, "bins are written on success alone, and only those");
    if (written) sum += counts[b];
  }
  if (status == TETLOD_OK && side == 1)
    DEMAND(sum == std::int64_t(session.last().values.size()), "each value of the result is in a bin: %ld", long(sum));
}

// ---- Results -------------------------------------------------------------------------------------------------------

using Fetch = tetlod_status (*)(const tetlod_context *, tetlod_array *);

/// Room for some tuples more or less than there are.
void fetch_into(Session &session, Bytes &in, std::int32_t type, std::int64_t tuples, std::int32_t components,
                const Fetch &call) {
  const std::int64_t room = std::max<std::int64_t>(0, tuples + in.between(-2, 3));
  Block block(in.one_in(2) ? decode_layout(type, room, components, in) : packed(type, room, components));
  tetlod_array array = block.array();
  const tetlod_array before = array;
  const tetlod_status status = call(session.context(), &array);
  DEMAND(std::memcmp(&array, &before, sizeof array) == 0, "the description is not changed");
  DEMAND(status == (!session.has_result() ? TETLOD_ERR_STATE
                    : room < tuples       ? TETLOD_ERR_BUFFER_SIZE
                                          : TETLOD_OK),
         "room for %ld, %ld wanted: %d", long(room), long(tuples), status);
  DEMAND(block.rest_untouched(status == TETLOD_OK ? tuples : 0), "only the tuples of the result are written");
}

void fetch_result(Session &session, Bytes &in) {
  const std::int32_t real = in.one_in(2) ? TETLOD_FLOAT32 : TETLOD_FLOAT64;
  const std::int32_t integer = in.one_in(2) ? TETLOD_INT64 : TETLOD_INT32;
  static const Fetched none;
  const Fetched &last = session.has_result() ? session.last() : none;
  const auto count = [](const auto &array) { return std::int64_t(array.size()); };
  const auto tets = [](const tetlod_context *c, tetlod_array *dst) { return tetlod_fetch_tets(c, 1, dst); };
  const auto boundary = [](const tetlod_context *c, tetlod_array *dst) { return tetlod_fetch_boundary(c, 1, dst); };
  switch (in.below(4)) {
    case 0: return fetch_into(session, in, real, count(last.points), 3, tetlod_fetch_points);
    case 1: return fetch_into(session, in, real, count(last.values), 1, tetlod_fetch_scalars);
    case 2: return fetch_into(session, in, integer, count(last.tets), 4, tets);
    default: return fetch_into(session, in, integer, count(last.boundary), 3, boundary);
  }
}

/// Any field that was not there before: constant, so that what it becomes is known.
void transfer_constant(Session &session, Bytes &in) {
  const double constant = in.real();
  const std::size_t points = session.mesh().points.size();
  const std::size_t points_out = session.has_result() ? session.last().points.size() : 0;
  std::vector<double> from(points, constant), to(points_out, -5.0);
  const auto described = [](std::vector<double> &values) {
    tetlod_array array{};
    array.struct_size = sizeof array;
    array.type = TETLOD_FLOAT64;
    array.tuples = std::int64_t(values.size());
    array.components = 1;
    array.data = values.data();
    return array;
  };
  tetlod_array original = described(from), simplified = described(to);
  const tetlod_status status = tetlod_transfer(session.context(), &original, &simplified);
  check_documented("tetlod_transfer", status, {TETLOD_ERR_STATE, TETLOD_ERR_MEMORY_LIMIT, TETLOD_ERR_MESH_NONFINITE});
  if (status == TETLOD_OK) session.stencil_was_found();
  for (const double value : to) {
    const double wanted = status == TETLOD_OK ? constant : -5.0;
    DEMAND(value == wanted || (std::isnan(value) && !std::isfinite(wanted)), "a constant stays one: %g", value);
  }
}

void fetch_field(Session &session, Bytes &in) { session.fetch_field(in); }
void fetch_stencil(Session &session, Bytes &in) { session.fetch_stencil(in); }
void transfer(Session &session, Bytes &in) { session.transfer(in); }

void look_at_result(Session &session, Bytes &) { session.check_kept(); }

void listen(Session &session, Bytes &in) {
  const auto log = [](void *, std::int32_t level, const char *message) {
    DEMAND(level >= 0 && level <= 2 && message && *message, "a log message has a level and a text");
  };
  tetlod_set_log(session.context(), in.one_in(2) ? nullptr : tetlod_log_fn(log), nullptr, std::int32_t(in.below(4)));
}

using Step = void (*)(Session &, Bytes &);
constexpr Step steps[] = {run,
                          run,
                          run,
                          submit_mesh,
                          submit_in_layouts,
                          submit_one_slot,
                          set_option,
                          set_option,
                          set_option,
                          set_by_name,
                          set_preset,
                          check,
                          check,
                          estimate,
                          measure,
                          count_values,
                          fetch_result,
                          fetch_result,
                          transfer_constant,
                          forget_input,
                          listen,
                          look_at_result,
                          cancel_nothing,
                          run_another_way,
                          run_another_way,
                          ask_texts,
                          call_with_nothing,
                          make_wrong_context,
                          submit_field,
                          submit_steering,
                          submit_flags,
                          set_target,
                          set_target,
                          fetch_field,
                          fetch_stencil,
                          transfer};

Conditions decode_conditions(Bytes &in) {
  Conditions conditions;
  conditions.hooks = !in.one_in(8);
  if (in.one_in(8)) conditions.memory_limit = 1 + in.raw<std::uint32_t>() % (1u << 22);
  conditions.no_remesher = in.one_in(16);
  return conditions;
}

}  // namespace

}  // namespace fuzz

extern "C" int LLVMFuzzerInitialize(int *, char ***) {
  fuzz::settle();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::Bytes in(data, size);
  fuzz::Session session(fuzz::decode_conditions(in));
  if (in.one_in(2)) fuzz::set_target(session, in);
  fuzz::submit_mesh(session, in);
  for (std::size_t fields = in.one_in(4) ? 1 + in.below(2) : 0; fields > 0; fields--) session.submit_field(in);
  if (in.one_in(8)) session.submit_flags(in);
  bool failed = session.run({}) == TETLOD_ERR_REMESH;
  for (int i = 0; i < fuzz::most_steps && !in.empty(); i++) fuzz::steps[in.below(std::size(fuzz::steps))](session, in);
  if (failed) fuzz::keep("remesh", data, size);
  return 0;
}

#include "session.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "demand.hpp"

namespace fuzz {

namespace {

constexpr double patience = 20;  // seconds for a run of a small mesh: more, and something loops

bool is_one_of(tetlod_status status, std::initializer_list<tetlod_status> list) {
  return std::find(list.begin(), list.end(), status) != list.end();
}

bool is_about_mesh(tetlod_status status) {
  return status >= TETLOD_ERR_MESH_EMPTY && status <= TETLOD_ERR_MESH_TOO_LARGE;
}

}  // namespace

Disturbance decode_disturbance(Bytes &in) {
  Disturbance what;
  switch (in.below(12)) {
    case 1: what.cancel_at_progress = long(in.below(16)); break;
    case 2: what.cancel_at_call = long(in.below(16)); break;
    case 3: what.cancel_at_allocation = long(in.below(1000)); break;
    case 4:
      what.fail_at_allocation = long(in.below(1000));
      what.failures = 1 + long(in.below(4));
      break;
    case 5: what.throw_at_progress = long(in.below(16)); break;
    default: break;
  }
  return what;
}

void check_documented(const char *call, tetlod_status status, std::initializer_list<tetlod_status> documented) {
  DEMAND(status != TETLOD_ERR_INTERNAL, "%s: no call ends with a defect of the library", call);
  const bool anywhere = is_one_of(status, {TETLOD_OK, TETLOD_ERR_ARGUMENT, TETLOD_ERR_MEMORY});
  DEMAND(anywhere || is_one_of(status, documented), "%s: status %d is documented", call, status);
}

// ---- Life ----------------------------------------------------------------------------------------------------------

Session::Session(const Conditions &conditions)
    : conditions_(conditions), files_before_(open_files()), children_before_(has_children()) {
  tetlod_config config{};
  config.struct_size = sizeof config;
  config.api_version = TETLOD_API_VERSION;
  if (conditions.hooks) allocator_.install(config);
  config.memory_limit = conditions.memory_limit;
  if (conditions.no_remesher) config.remesher = "/nonexistent/tetlod-remesh";
  const tetlod_status status = tetlod_create(&config, &context_);
  DEMAND(status == TETLOD_OK && context_, "a context can be made: %d", status);
  tetlod_set_real(context_, TETLOD_OPT_TIME_LIMIT, patience);
}

Session::~Session() {
  tetlod_destroy(context_);
  DEMAND(allocator_.in_use() == 0, "all memory is given back: %zu bytes are not", allocator_.in_use());
  DEMAND(open_files() == files_before_, "no descriptor is left: %d, before %d", open_files(), files_before_);
  DEMAND(children_before_ || !has_children(), "no process is left");
}

std::string Session::message() const {
  char text[2048];
  const std::size_t length = tetlod_last_message(context_, text, sizeof text);
  DEMAND(length == std::strlen(text), "a message has the length that is told");
  return text;
}

// ---- Slots ---------------------------------------------------------------------------------------------------------

Mesh Session::mesh() const {
  Mesh mesh;
  for (std::int64_t i = 0; points_ && i < points_->layout().tuples; i++)
    mesh.points.push_back({points_->real(i, 0), points_->real(i, 1), points_->real(i, 2)});
  for (std::int64_t i = 0; values_ && i < values_->layout().tuples; i++) mesh.values.push_back(values_->real(i, 0));
  for (std::int64_t t = 0; tets_ && t < tets_->layout().tuples; t++) {
    Corners tet;
    for (std::int32_t k = 0; k < 4; k++) {
      const std::int64_t v = tets_->integer(t, k);
      tet[std::size_t(k)] = v < base_ ? -1 : v - base_;
    }
    mesh.tets.push_back(tet);
  }
  mesh.id = sound_points_;
  mesh.sound = mesh.id && mesh.id == sound_tets_ && mesh.id == sound_values_;
  for (const auto &[name, values] : steering())  // a point with one value that is not finite has none
    for (std::int64_t i = 0; i < std::min(mesh.point_count(), values->layout().tuples); i++) {
      const double value = values->real(i, 0);
      if (std::isfinite(value) || std::size_t(i) >= mesh.values.size()) continue;
      mesh.values[std::size_t(i)] = value;
      mesh.sound = false;
    }
  return mesh;
}

void Session::clear() {
  DEMAND(tetlod_clear(context_) == TETLOD_OK, "what is submitted can be forgotten");
  points_ = tets_ = values_ = flags_ = nullptr;
  fields_.clear();
}

double Session::option(std::int32_t number) const {
  double real = 0;
  std::int64_t integer = 0;
  if (tetlod_get_real(context_, number, &real) == TETLOD_OK) return real;
  return tetlod_get_int(context_, number, &integer) == TETLOD_OK ? double(integer) : 0;
}

/// Within the bounds it is taken, otherwise it stays as it was.
void Session::set(const Setting &setting) {
  tetlod_bounds bounds{};
  bounds.struct_size = sizeof bounds;
  const bool known = tetlod_option_bounds(setting.option, &bounds) == TETLOD_OK;
  trace("option %d: %.17g\n", setting.option, setting.real);
  const double before = option(setting.option);
  const double wanted = bounds.is_integer ? double(setting.integer) : setting.real;
  const tetlod_status status = bounds.is_integer ? tetlod_set_int(context_, setting.option, setting.integer)
                                                 : tetlod_set_real(context_, setting.option, setting.real);
  const bool inside = known && wanted >= bounds.least && wanted <= bounds.most;
  DEMAND(status == (inside ? TETLOD_OK : TETLOD_ERR_OPTION), "option %d, %g: %d", setting.option, wanted, status);
  DEMAND(option(setting.option) == (inside ? wanted : before), "option %d has the value that was set", setting.option);
  const tetlod_status other =
      bounds.is_integer ? tetlod_set_real(context_, setting.option, 0) : tetlod_set_int(context_, setting.option, 0);
  DEMAND(other == TETLOD_ERR_OPTION, "option %d is of one kind: %d", setting.option, other);
}

bool Session::repairs(std::int32_t policy) const {
  std::int64_t value = 0;
  return tetlod_get_int(context_, policy, &value) == TETLOD_OK && value == TETLOD_POLICY_REPAIR;
}

/// Collapses do, TetGen does not.
bool Session::takes_contacts() const {
  const bool cleans = option(TETLOD_OPT_CLEAN_EDGES) > 0 && option(TETLOD_OPT_REMESH) != 0;
  return has_target() && !cleans && repairs(TETLOD_OPT_ON_OVERLAP);
}

bool Session::policies_repair() const {
  for (std::int32_t number = TETLOD_OPT_ON_COINCIDENT; number < TETLOD_OPT_ON_NONFINITE; number++)
    if (!repairs(number)) return false;
  return true;
}

// ---- Calls that work -----------------------------------------------------------------------------------------------

/// What the callbacks know.
struct Session::Callbacks {
  Session &session;
  const Disturbance &disturbance;
  long calls = 0;

  static std::int32_t progress(void *user, std::int32_t stage, double fraction) {
    auto &self = *static_cast<Callbacks *>(user);
    return self.on_progress(stage, fraction);
  }

  std::int32_t on_progress(std::int32_t stage, double fraction) {
    DEMAND(std::strcmp(tetlod_stage_name(stage), "unknown") != 0, "stage %d has a name", stage);
    DEMAND(fraction >= 0 && fraction <= 1, "stage %d: the fraction %g is in [0, 1]", stage, fraction);
    const long now = calls++;
    if (now == 0) DEMAND(tetlod_run(session.context()) == TETLOD_ERR_STATE, "no call inside a callback");
    if (now == disturbance.cancel_at_call) {
      session.fired_++;
      tetlod_cancel(session.context());
    }
    if (now == disturbance.throw_at_progress) {
      session.fired_++;
      throw std::runtime_error("the host's own trouble");
    }
    if (now != disturbance.cancel_at_progress) return 0;
    session.fired_++;
    return 1;
  }
};

tetlod_status Session::disturbed(const Disturbance &disturbance, const std::function<tetlod_status()> &call) {
  Callbacks callbacks{*this, disturbance};
  fired_ = 0;
  tetlod_set_progress(context_, Callbacks::progress, &callbacks);
  const std::size_t before = allocator_.in_use();
  if (disturbance.fail_at_allocation >= 0)
    allocator_.fail_after(disturbance.fail_at_allocation, disturbance.failures - 1);
  if (disturbance.cancel_at_allocation >= 0)
    allocator_.call_after(disturbance.cancel_at_allocation, [this] {
      fired_++;
      tetlod_cancel(context_);
    });
  const tetlod_status status = call();
  said_ = message();
  trace("status %d: %s\n", status, said_.c_str());
  allocator_.forget();
  tetlod_set_progress(context_, nullptr, nullptr);
  DEMAND(status == TETLOD_OK || allocator_.in_use() <= before,
         "after status %d memory is not more than before: %zu, was %zu", status, allocator_.in_use(), before);
  if (status != TETLOD_OK) DEMAND(!said_.empty(), "status %d has a message", status);
  return status;
}

/// Nobody is told of trouble that there was not.
void Session::check_trouble(const char *call, tetlod_status status, const Disturbance &disturbance) const {
  const std::string &said = said_;
  if (status == TETLOD_ERR_CANCELLED) DEMAND(fired_ > 0, "%s: cancelled by nobody: %s", call, said.c_str());
  if (status == TETLOD_ERR_MEMORY)
    DEMAND(allocator_.failed() && disturbance.fail_at_allocation >= 0, "%s: out of memory: %s", call, said.c_str());
  if (status == TETLOD_ERR_MEMORY_LIMIT)
    DEMAND(conditions_.memory_limit, "%s: there is a limit: %s", call, said.c_str());
  if (status == TETLOD_ERR_TIME_LIMIT)
    DEMAND(option(TETLOD_OPT_TIME_LIMIT) > 0 && option(TETLOD_OPT_TIME_LIMIT) < patience, "%s: time is up: %s", call,
           said.c_str());
  if (status == TETLOD_ERR_BACKEND_MISSING)
    DEMAND(option(TETLOD_OPT_REMESH) == 0 ? !has_target() : conditions_.no_remesher, "%s: no worker: %s", call,
           said.c_str());
}

bool Session::undisturbed_success_expected(const Mesh &mesh) const {
  return mesh.sound && policies_repair() && option(TETLOD_OPT_MERGE_TOLERANCE) == 0;
}

/// A status about the mesh has its reason in the mesh.
void Session::check_verdict(tetlod_status status, const Mesh &mesh, const Facts &facts) const {
  const std::string &said = said_;
  const bool drops = repairs(TETLOD_OPT_ON_NONFINITE);
  const bool nonfinite = facts.nonfinite_points || (facts.nonfinite_values && !drops);
  const bool empty = mesh.points.empty() || mesh.tets.empty();
  if (status == TETLOD_OK) {
    DEMAND(!empty && !facts.index && !nonfinite, "a mesh with holes in it is no success");
    DEMAND(!facts.nonmanifold_faces || facts.wide || option(TETLOD_OPT_MERGE_TOLERANCE) > 0,
           "nor is one that is not a manifold");
    return;
  }
  const bool about_remesher = status == TETLOD_ERR_REMESH;
  if (is_about_mesh(status) || about_remesher)
    DEMAND(!undisturbed_success_expected(mesh), "a sound mesh is simplified: %d, %s", status, said.c_str());
  if (!policies_repair()) return;  // the strict ones come first, and some speak with another's status
  if (status == TETLOD_ERR_MESH_INDEX) DEMAND(facts.index, "a vertex is out of range: %s", said.c_str());
  if (status == TETLOD_ERR_MESH_NONFINITE) DEMAND(nonfinite, "a number is not finite: %s", said.c_str());
  const bool merges = option(TETLOD_OPT_MERGE_TOLERANCE) > 0;
  if (status == TETLOD_ERR_MESH_NONMANIFOLD && !merges && !facts.wide)
    DEMAND(facts.nonmanifold_faces, "a face has more than two tets: %s", said.c_str());
  if (facts.index && !empty) DEMAND(status == TETLOD_ERR_MESH_INDEX || !is_about_mesh(status), "an index: %d", status);
}

tetlod_status Session::run(const Disturbance &disturbance) {
  const Mesh mesh = this->mesh();
  trace(mesh);
  const tetlod_status status = disturbed(disturbance, [&] { return tetlod_run(context_); });
  check_documented("tetlod_run", status,
                   {TETLOD_ERR_STATE, TETLOD_ERR_MEMORY_LIMIT, TETLOD_ERR_CANCELLED, TETLOD_ERR_TIME_LIMIT,
                    TETLOD_ERR_REMESH, TETLOD_ERR_MAX_ERROR, TETLOD_ERR_BACKEND_MISSING, TETLOD_ERR_MESH_EMPTY,
                    TETLOD_ERR_MESH_INDEX, TETLOD_ERR_MESH_NONFINITE, TETLOD_ERR_MESH_DEGENERATE,
                    TETLOD_ERR_MESH_NONMANIFOLD, TETLOD_ERR_MESH_INTERSECTING, TETLOD_ERR_MESH_TOO_LARGE});
  check_trouble("tetlod_run", status, disturbance);
  const bool counts_fit = mesh.points.size() == mesh.values.size() && fields_fit();
  if (complete() && counts_fit && !flags_fit()) {
    DEMAND(status != TETLOD_OK, "flags without a meaning, or too few of them, are no success");
    return check_kept(), status;
  }
  if (!complete())
    DEMAND(status == TETLOD_ERR_STATE, "nothing is run without input: %d", status);
  else if (!counts_fit)
    DEMAND(status == TETLOD_ERR_ARGUMENT, "a value a point, a tuple a point or tet: %d", status);
  else
    DEMAND(status != TETLOD_ERR_ARGUMENT && status != TETLOD_ERR_STATE, "%d: %s", status, said_.c_str());
  if (!complete() || !counts_fit) return check_kept(), status;
  const Facts facts =
      facts_of(mesh, {repairs(TETLOD_OPT_ON_NONFINITE), takes_contacts(), repairs(TETLOD_OPT_ON_OVERLAP)});
  check_verdict(status, mesh, facts);
  if (status == TETLOD_OK)
    accept(mesh, facts);
  else
    check_kept();
  return status;
}

void Session::run_another_size_between(double ratio) {
  const double asked = option(TETLOD_OPT_TARGET_RATIO);
  if (asked <= 0 || option(TETLOD_OPT_WARM_START) > 0) return;  // bytes then depend on the runs before
  const std::uint64_t wanted = hash_;
  set({TETLOD_OPT_TARGET_RATIO, ratio, 0});
  run({});
  set({TETLOD_OPT_TARGET_RATIO, asked, 0});
  const tetlod_status status = run({});
  if (status == TETLOD_ERR_MEMORY_LIMIT || status == TETLOD_ERR_TIME_LIMIT) return;  // the other result takes some, too
  DEMAND(status == TETLOD_OK, "what could be run can be run again: %d", status);
  DEMAND(hash_ == wanted, "the same size gives the same bytes");
}

void Session::check_kept() {
  if (!last_) {
    std::int64_t points = 7;
    DEMAND(tetlod_fetch_counts(context_, &points, nullptr, nullptr) == TETLOD_ERR_STATE && points == 7,
           "there is no result before the first success");
    return;
  }
  DEMAND(same(*last_, fetch(context_)), "a failure leaves the result as it was");
  check_carried_kept();
}

void Session::estimate(const Disturbance &disturbance) {
  constexpr std::uint64_t untouched = 0x5a5a5a5a5a5a5a5a;
  std::uint64_t bytes = untouched;
  const tetlod_status status = disturbed(disturbance, [&] { return tetlod_estimate_memory(context_, &bytes); });
  check_documented("tetlod_estimate_memory", status,
                   {TETLOD_ERR_STATE, TETLOD_ERR_MEMORY_LIMIT, TETLOD_ERR_CANCELLED, TETLOD_ERR_TIME_LIMIT,
                    TETLOD_ERR_MESH_EMPTY, TETLOD_ERR_MESH_INDEX, TETLOD_ERR_MESH_NONFINITE, TETLOD_ERR_MESH_DEGENERATE,
                    TETLOD_ERR_MESH_NONMANIFOLD, TETLOD_ERR_MESH_INTERSECTING});
  check_trouble("tetlod_estimate_memory", status, disturbance);
  DEMAND((status == TETLOD_OK) == (bytes != untouched), "an output is written on success alone");
  check_kept();
}

}  // namespace fuzz

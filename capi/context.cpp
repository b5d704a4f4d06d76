// Versions, texts, and the life of a context.
#include "context.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <limits>

#include "arguments.hpp"

namespace tetlod::capi {

namespace {

void *allocate(void *user, std::size_t bytes, std::size_t alignment) {
  const auto &host = *static_cast<const HostAllocator *>(user);
  return call_allocator([&] { return host.allocate(host.user, bytes, alignment); });
}

void release(void *user, void *pointer, std::size_t bytes, std::size_t alignment) {
  const auto &host = *static_cast<const HostAllocator *>(user);
  call_allocator([&]() -> void * {
    host.release(host.user, pointer, bytes, alignment);
    return nullptr;
  });
}

void require_known_version(std::uint32_t version) {
  const std::uint32_t major = version / 10000, minor = version / 100 % 100;
  if (version > 0 && major == TETLOD_VERSION_MAJOR && minor <= TETLOD_VERSION_MINOR) return;
  fail(Status::struct_size, "config: api_version %u is of version %u.%u, the library is %d.%d", version, major, minor,
       TETLOD_VERSION_MAJOR, TETLOD_VERSION_MINOR);
}

void require_whole_allocator(const tetlod_config &config) {
  if (!config.allocate != !config.release)
    fail(Status::argument, "config: allocate and release go together, %s is NULL",
         config.allocate ? "release" : "allocate");
}

void require_path(const char *remesher) {
  if (remesher && !*remesher) fail(Status::argument, "config: remesher is an empty path");
}

tetlod_config default_config() {
  tetlod_config config{};
  config.struct_size = sizeof config;
  config.api_version = TETLOD_API_VERSION;
  return config;
}

/// The caller's struct may be longer than ours, never shorter than that of the first version.
tetlod_config checked_config(const tetlod_config *given) {
  if (!given) return default_config();
  require_struct(given, "config", TETLOD_SIZE_TO(tetlod_config, remesher));
  require_known_version(given->api_version);
  tetlod_config config{};
  std::memcpy(&config, given, std::min<std::size_t>(given->struct_size, sizeof config));
  require_whole_allocator(config);
  require_path(config.remesher);
  return config;
}

std::size_t as_size(std::uint64_t bytes) {
  return std::size_t(std::min<std::uint64_t>(bytes, std::numeric_limits<std::size_t>::max()));
}

struct StatusText {
  tetlod_status status;
  const char *text;
};

constexpr StatusText status_texts[] = {
    {TETLOD_OK, "no error"},
    {TETLOD_ERR_INTERNAL, "a defect of the library"},
    {TETLOD_ERR_ARGUMENT, "an argument makes no sense"},
    {TETLOD_ERR_OPTION, "unknown option, or value out of its bounds"},
    {TETLOD_ERR_STATE, "called in the wrong order"},
    {TETLOD_ERR_STRUCT_SIZE, "struct_size not set, or of another version"},
    {TETLOD_ERR_BUFFER_SIZE, "the destination is too small"},
    {TETLOD_ERR_MEMORY, "out of memory"},
    {TETLOD_ERR_MEMORY_LIMIT, "the memory limit would be passed"},
    {TETLOD_ERR_CANCELLED, "cancelled"},
    {TETLOD_ERR_TIME_LIMIT, "the time limit is used up"},
    {TETLOD_ERR_MESH_EMPTY, "the mesh has no points or no tets"},
    {TETLOD_ERR_MESH_INDEX, "a tet names a vertex that the mesh does not have"},
    {TETLOD_ERR_MESH_NONFINITE, "a coordinate or value is NaN or infinite"},
    {TETLOD_ERR_MESH_DEGENERATE, "the mesh is flat, too small for doubles, or has a defect that is not repaired"},
    {TETLOD_ERR_MESH_NONMANIFOLD, "a face of the mesh has more than two tets"},
    {TETLOD_ERR_MESH_INTERSECTING, "the mesh crosses or overlaps itself"},
    {TETLOD_ERR_MESH_PARTITION, "the partition of the mesh makes no sense"},
    {TETLOD_ERR_MESH_TOO_LARGE, "the mesh has 2^29 points or tets, or more"},
    {TETLOD_ERR_REMESH, "no sound mesh of the boundary was found"},
    {TETLOD_ERR_BACKEND_MISSING, "tetlod-remesh cannot be run, or may not be"},
    {TETLOD_ERR_MAX_ERROR, "the bound of the error cannot be held"},
};

constexpr const char *stage_names[] = {"prepare", "boundary", "decimate", "sample", "cull", "remesh", "values"};
static_assert(std::size(stage_names) == std::size_t(Stage::count), "a name for each stage");

/// The message is the context's, unless another thread is at it or it is none.
const Message &message_of(const tetlod_context *handle) noexcept {
  Message &own = thread_message();
  if (!handle || !checked(handle)) return own;
  const Message *const caller = handle->caller.load();
  return !caller || caller == &own ? handle->message : own;
}

#define TETLOD_TEXT_(x) #x
#define TETLOD_TEXT(x) TETLOD_TEXT_(x)
#define TETLOD_DOTTED(a, b, c) TETLOD_TEXT(a) "." TETLOD_TEXT(b) "." TETLOD_TEXT(c)

constexpr char build_info[] =
    "tetlod " TETLOD_DOTTED(TETLOD_VERSION_MAJOR, TETLOD_VERSION_MINOR, TETLOD_VERSION_PATCH) " (MIT); "
    "OpenMesh (BSD-3-Clause), "
    "GLM " TETLOD_DOTTED(GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH) " (MIT); "
    "in a process of its own, tetlod-remesh: TetGen (AGPL-3.0)";

}  // namespace

AllocatorHooks HostAllocator::hooks() noexcept {
  if (!allocate) return {};
  return {capi::allocate, capi::release, this};
}

Outcome &last_outcome(tetlod_context &context) {
  if (!context.outcome) fail(Status::state, "there is no result: tetlod_run has not succeeded yet");
  return *context.outcome;
}

const Outcome &last_outcome(const tetlod_context &context) {
  return last_outcome(const_cast<tetlod_context &>(context));
}

}  // namespace tetlod::capi

using namespace tetlod;
using namespace tetlod::capi;

tetlod_context::tetlod_context(const tetlod_config &config)
    : allocator{config.allocate, config.release, config.allocator_user},
      memory(allocator.hooks(), as_size(config.memory_limit)),
      worker(config.remesher ? config.remesher : "", config.memory_limit) {}

void tetlod_version(int32_t *major, int32_t *minor, int32_t *patch) {
  if (major) *major = TETLOD_VERSION_MAJOR;
  if (minor) *minor = TETLOD_VERSION_MINOR;
  if (patch) *patch = TETLOD_VERSION_PATCH;
}

const char *tetlod_build_info(void) { return build_info; }

const char *tetlod_status_text(tetlod_status status) {
  for (const StatusText &row : status_texts)
    if (row.status == status) return row.text;
  return "no status of this version";
}

const char *tetlod_stage_name(int32_t stage) {
  return stage >= 0 && stage < std::int32_t(Stage::count) ? stage_names[stage] : "unknown";
}

tetlod_status tetlod_create(const tetlod_config *config, tetlod_context **out) {
  return entry([&] {
    require_pointer(out, "out");
    *out = std::make_unique<tetlod_context>(checked_config(config)).release();
  });
}

void tetlod_destroy(tetlod_context *handle) {
  if (!handle) return;
  const HostState host;  // its second life: what follows runs after entry has given the turn back
  std::unique_ptr<tetlod_context> doomed;
  entry(handle, [&](tetlod_context &context) { doomed.reset(&context); });
}

size_t tetlod_last_message(const tetlod_context *handle, char *buffer, size_t capacity) {
  return message_of(handle).copy(buffer, capacity);
}

tetlod_status tetlod_set_log(tetlod_context *handle, tetlod_log_fn fn, void *user, int32_t min_level) {
  return entry(handle, [&](tetlod_context &context) { context.log = {fn, user, min_level}; });
}

tetlod_status tetlod_set_progress(tetlod_context *handle, tetlod_progress_fn fn, void *user) {
  return entry(handle, [&](tetlod_context &context) { context.progress = {fn, user}; });
}

void tetlod_cancel(tetlod_context *handle) {
  if (tetlod_context *const context = checked(handle)) context->cancel.store(true, std::memory_order_relaxed);
}

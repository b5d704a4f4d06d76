// tetlod from C++17: the C ABI of tetlod.h with an owner, views and exceptions. Header only; link libtetlod.
//
//     tetlod::Context lod;
//     lod.set_real(TETLOD_OPT_TARGET_RATIO, 0.1);
//     lod.submit_points({xyz.data(), n, 3});           // borrowed, not copied
//     lod.submit_tets({corners.data(), m, 4}, 0);
//     lod.submit_scalars("density", {density.data(), n});
//     lod.run();
//     for (double x : lod.view_points()) ...
//
// A call that fails throws tetlod::Error with the status; what it says, who owns what, and which thread may call is
// written in tetlod.h, under the same names.
#ifndef TETLOD_HPP
#define TETLOD_HPP

#include <tetlod.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace tetlod {
// The library has a tetlod::Error of its own, which a program that links it statically must not take for this one.
inline namespace wrapper {

class Error : public std::runtime_error {
 public:
  Error(tetlod_status status, const std::string &message) : std::runtime_error(message), status_(status) {}
  tetlod_status status() const noexcept { return status_; }

 private:
  tetlod_status status_;
};

/// 0: there is none. Of integers the width counts: long and long long may both be of 64 bits.
template <class T>
constexpr std::int32_t element_type = std::is_same_v<T, float>                         ? TETLOD_FLOAT32
                                      : std::is_same_v<T, double>                      ? TETLOD_FLOAT64
                                      : std::is_same_v<T, std::uint8_t>                ? TETLOD_UINT8
                                      : !std::is_integral_v<T> || !std::is_signed_v<T> ? 0
                                      : sizeof(T) == 4                                 ? TETLOD_INT32
                                      : sizeof(T) == 8                                 ? TETLOD_INT64
                                                                                       : 0;

/// An array of the caller's, anywhere; strides are in bytes, 0 means packed. See tetlod_array.
class Source {
 public:
  template <class T>
  Source(const T *data, std::int64_t tuples, std::int32_t components = 1, std::int64_t tuple_stride = 0,
         std::int64_t component_stride = 0)
      : array{sizeof array,     element_type<T>,      tuples, components, 0, tuple_stride,
              component_stride, const_cast<T *>(data)} {  // the library never writes to what is submitted
    static_assert(element_type<T> != 0, "elements are signed integers of 32 or 64 bits, float, double or uint8_t");
  }
  tetlod_array array;
};

/// The same to be written to.
class Destination {
 public:
  template <class T>
  Destination(T *data, std::int64_t tuples, std::int32_t components = 1, std::int64_t tuple_stride = 0,
              std::int64_t component_stride = 0)
      : array{sizeof array, element_type<T>, tuples, components, 0, tuple_stride, component_stride, data} {
    static_assert(element_type<T> != 0, "elements are signed integers of 32 or 64 bits, float, double or uint8_t");
  }
  tetlod_array array;
};

/// The library's own packed array, valid until the next successful run or the context's end.
template <class T>
class View {
 public:
  explicit View(const tetlod_array &array)
      : data_(static_cast<const T *>(array.data)), tuples_(array.tuples), components_(array.components) {}
  const T *data() const noexcept { return data_; }
  std::int64_t tuples() const noexcept { return tuples_; }
  std::int32_t components() const noexcept { return components_; }
  std::size_t size() const noexcept { return std::size_t(tuples_) * std::size_t(components_); }
  const T *begin() const noexcept { return data_; }
  const T *end() const noexcept { return data_ + size(); }
  const T &operator()(std::int64_t tuple, std::int32_t component = 0) const noexcept {
    return data_[tuple * components_ + component];
  }

 private:
  const T *data_;
  std::int64_t tuples_;
  std::int32_t components_;
};

struct Counts {
  std::int64_t points = 0, tets = 0, boundary_triangles = 0;
};
struct Version {
  std::int32_t major = 0, minor = 0, patch = 0;
};

inline Version version() {
  Version v;
  tetlod_version(&v.major, &v.minor, &v.patch);
  return v;
}
inline const char *build_info() { return tetlod_build_info(); }
inline const char *status_text(tetlod_status status) { return tetlod_status_text(status); }
inline const char *stage_name(std::int32_t stage) { return tetlod_stage_name(stage); }
inline std::int32_t option_from_name(const std::string &name) { return tetlod_option_from_name(name.c_str()); }
/// nullptr for a number that is no option.
inline const char *option_name(std::int32_t option) { return tetlod_option_name(option); }
namespace detail {
/// Of the last call that failed, in a context, or, for nullptr, in this thread without one.
inline std::string message_of(const tetlod_context *context) {
  std::vector<char> text(tetlod_last_message(context, nullptr, 0) + 1);
  tetlod_last_message(context, text.data(), text.size());
  return text.data();
}
}  // namespace detail

inline tetlod_bounds option_bounds(std::int32_t option) {
  tetlod_bounds bounds = {};
  bounds.struct_size = sizeof bounds;
  const tetlod_status status = tetlod_option_bounds(option, &bounds);
  if (status != TETLOD_OK) throw Error(status, "option_bounds: " + detail::message_of(nullptr));
  return bounds;
}

/// Called on the thread that runs. What they throw cancels the run (progress) or is kept until it ends (log), and is
/// then thrown by the call that ran: it never passes through the library. They may assign to the Context that calls
/// them, or end it: the context that runs ends after the call then, with its result.
using LogFunction = std::function<void(std::int32_t level, const char *message)>;
using ProgressFunction = std::function<bool(std::int32_t stage, double fraction)>;  // true cancels

class Context {
 public:
  Context() : Context(default_config()) {}
  /// config as tetlod_create takes it; struct_size and api_version are set here.
  explicit Context(tetlod_config config) : callbacks_(std::make_shared<Callbacks>()) {
    config.struct_size = sizeof config;
    config.api_version = TETLOD_API_VERSION;
    require(tetlod_create(&config, &handle_));
    callbacks_->called_by = handle_;
  }
  Context(Context &&other) noexcept
      : handle_(std::exchange(other.handle_, nullptr)), callbacks_(std::move(other.callbacks_)) {}
  /// What this was ends.
  Context &operator=(Context &&other) noexcept {
    Context taken(std::move(other));
    std::swap(handle_, taken.handle_);
    std::swap(callbacks_, taken.callbacks_);
    return *this;
  }

  /// For functions of the C ABI.
  tetlod_context *get() const noexcept { return handle_; }
  std::string last_message() const { return detail::message_of(handle_); }

  /// An empty function: none.
  void set_log(LogFunction log, std::int32_t min_level = 1) {
    require(tetlod_set_log(handle_, log ? &call_log : nullptr, callbacks_.get(), min_level));
    callbacks_->log = std::move(log);
  }
  void set_progress(ProgressFunction progress) {
    require(tetlod_set_progress(handle_, progress ? &call_progress : nullptr, callbacks_.get()));
    callbacks_->progress = std::move(progress);
  }
  /// The one call allowed from another thread.
  void cancel() noexcept { tetlod_cancel(handle_); }

  void set_rho(double rho) { require(tetlod_set_rho(handle_, rho)); }
  void set_sigma(double sigma) { require(tetlod_set_sigma(handle_, sigma)); }
  void set_lambda(double lambda) { require(tetlod_set_lambda(handle_, lambda)); }
  void set_min_distance(double fraction) { require(tetlod_set_min_distance(handle_, fraction)); }
  void set_preset(std::int32_t preset) { require(tetlod_set_preset(handle_, preset)); }
  void set_real(std::int32_t option, double value) { require(tetlod_set_real(handle_, option, value)); }
  void set_int(std::int32_t option, std::int64_t value) { require(tetlod_set_int(handle_, option, value)); }
  double get_real(std::int32_t option) const {
    double value = 0;
    require(tetlod_get_real(handle_, option, &value));
    return value;
  }
  std::int64_t get_int(std::int32_t option) const {
    std::int64_t value = 0;
    require(tetlod_get_int(handle_, option, &value));
    return value;
  }

  void submit_points(const Source &xyz) { require(tetlod_submit_points(handle_, &xyz.array)); }
  void submit_points_xyz(const Source &x, const Source &y, const Source &z) {
    require(tetlod_submit_points_xyz(handle_, &x.array, &y.array, &z.array));
  }
  void submit_tets(const Source &corners, std::int32_t index_base) {
    require(tetlod_submit_tets(handle_, &corners.array, index_base));
  }
  void submit_scalars(const std::string &name, const Source &values) {
    require(tetlod_submit_scalars(handle_, name.c_str(), &values.array));
  }
  void submit_field(const std::string &name, std::int32_t association, const Source &values) {
    require(tetlod_submit_field(handle_, name.c_str(), association, &values.array));
  }
  void submit_steering(const std::string &name, double weight, const Source &values) {
    require(tetlod_submit_steering(handle_, name.c_str(), weight, &values.array));
  }
  void withdraw_field(const std::string &name) { require(tetlod_withdraw_field(handle_, name.c_str())); }
  void submit_point_flags(const Source &flags) { require(tetlod_submit_point_flags(handle_, &flags.array)); }
  void clear() { require(tetlod_clear(handle_)); }

  tetlod_mesh_report check() { return report<tetlod_mesh_report>(tetlod_check); }
  std::uint64_t estimate_memory() {
    std::uint64_t bytes = 0;
    require_of([&](tetlod_context *handle) { return tetlod_estimate_memory(handle, &bytes); });
    return bytes;
  }
  void run() { require_of(tetlod_run); }
  tetlod_error_report measure_error(std::int32_t samples_per_tet) {
    return report<tetlod_error_report>([samples_per_tet](tetlod_context *handle, tetlod_error_report *out) {
      return tetlod_measure_error(handle, samples_per_tet, out);
    });
  }
  std::vector<std::int64_t> histogram(std::int32_t side, std::int32_t bins) const {
    constexpr std::int32_t most = 1 << 20;  // beyond, C refuses
    std::vector<std::int64_t> counts(std::size_t(std::clamp(bins, 1, most)));
    require(tetlod_histogram(handle_, side, bins, counts.data()));
    return counts;
  }

  Counts fetch_counts() const {
    Counts n;
    require(tetlod_fetch_counts(handle_, &n.points, &n.tets, &n.boundary_triangles));
    return n;
  }
  void fetch_points(Destination dst) const { require(tetlod_fetch_points(handle_, &dst.array)); }
  void fetch_tets(std::int32_t index_base, Destination dst) const {
    require(tetlod_fetch_tets(handle_, index_base, &dst.array));
  }
  void fetch_boundary(std::int32_t index_base, Destination dst) const {
    require(tetlod_fetch_boundary(handle_, index_base, &dst.array));
  }
  void fetch_scalars(Destination dst) const { require(tetlod_fetch_scalars(handle_, &dst.array)); }
  void fetch_field(const std::string &name, Destination dst) const {
    require(tetlod_fetch_field(handle_, name.c_str(), &dst.array));
  }
  void fetch_stencil(std::int32_t index_base, Destination ids, Destination weights) const {
    require_of(
        [&](tetlod_context *handle) { return tetlod_fetch_stencil(handle, index_base, &ids.array, &weights.array); });
  }
  void transfer(const Source &original, Destination simplified) {
    require_of([&](tetlod_context *handle) { return tetlod_transfer(handle, &original.array, &simplified.array); });
  }
  tetlod_run_report fetch_report() const { return report<tetlod_run_report>(tetlod_fetch_report); }

  View<double> view_points() const { return view<double>(tetlod_view_points); }
  View<std::int32_t> view_tets() const { return view<std::int32_t>(tetlod_view_tets); }
  View<double> view_scalars() const { return view<double>(tetlod_view_scalars); }

 private:
  /// With the context that calls them, so that both end together: at the Context's end, or after the call under way.
  struct Callbacks {
    LogFunction log;
    ProgressFunction progress;
    std::exception_ptr thrown;
    tetlod_context *called_by = nullptr;

    Callbacks() = default;
    Callbacks(const Callbacks &) = delete;
    Callbacks &operator=(const Callbacks &) = delete;
    ~Callbacks() { tetlod_destroy(called_by); }
  };

  static tetlod_config default_config() { return {}; }

  static void call_log(void *user, std::int32_t level, const char *message) noexcept {
    auto *callbacks = static_cast<Callbacks *>(user);
    try {
      callbacks->log(level, message);
    } catch (...) {
      if (!callbacks->thrown) callbacks->thrown = std::current_exception();
    }
  }

  static std::int32_t call_progress(void *user, std::int32_t stage, double fraction) noexcept {
    auto *callbacks = static_cast<Callbacks *>(user);
    try {
      return callbacks->progress(stage, fraction) ? 1 : 0;
    } catch (...) {
      if (!callbacks->thrown) callbacks->thrown = std::current_exception();
      return 1;
    }
  }

  /// What a callback threw goes first: the library's status is its consequence.
  static void require(tetlod_status status, tetlod_context *handle, Callbacks *callbacks) {
    if (callbacks && callbacks->thrown) std::rethrow_exception(std::exchange(callbacks->thrown, nullptr));
    if (status != TETLOD_OK) throw Error(status, detail::message_of(handle));
  }
  void require(tetlod_status status) const { require(status, handle_, callbacks_.get()); }

  /// The same of a call that may call back: afterwards this Context may be another one, or gone.
  template <class Call>
  void require_of(Call call) const {
    const std::shared_ptr<Callbacks> callbacks = callbacks_;
    tetlod_context *const handle = handle_;
    require(call(handle), handle, callbacks.get());
  }

  template <class Report, class Call>
  Report report(Call call) const {
    Report out = {};
    out.struct_size = sizeof out;
    require_of([&](tetlod_context *handle) { return call(handle, &out); });
    return out;
  }

  template <class T, class Call>
  View<T> view(Call call) const {
    tetlod_array out = {};
    out.struct_size = sizeof out;
    require(call(handle_, &out));
    return View<T>(out);
  }

  tetlod_context *handle_ = nullptr;
  std::shared_ptr<Callbacks> callbacks_;  // in place when the context moves; shared with a call under way
};

}  // namespace wrapper
}  // namespace tetlod

#endif

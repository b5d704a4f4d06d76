// A host with one context: what it has submitted, set and been given, so that every call can be compared with what the
// header promises.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "decoder.hpp"
#include "host.hpp"
#include "layouts.hpp"
#include "oracle.hpp"
#include "tetlod.h"

namespace fuzz {

/// How a context is made.
struct Conditions {
  bool hooks = true;
  std::uint64_t memory_limit = 0;
  bool no_remesher = false;  ///< the path of one that is not there
};

/// What the host does while a call works. Counts from 0; negative: never.
struct Disturbance {
  long cancel_at_progress = -1;  ///< the callback says so
  long cancel_at_call = -1;      ///< tetlod_cancel from a callback
  long throw_at_progress = -1;
  long cancel_at_allocation = -1;
  long fail_at_allocation = -1;
  long failures = 1;
  bool any() const {
    return cancel_at_progress >= 0 || cancel_at_call >= 0 || throw_at_progress >= 0 || cancel_at_allocation >= 0 ||
           fail_at_allocation >= 0;
  }
};
Disturbance decode_disturbance(Bytes &in);

/// A vertex of a result as a mean of original ones, with numbers from 0.
struct Stencil {
  std::vector<std::array<std::int64_t, 4>> ids;
  std::vector<std::array<double, 4>> weights;
};

/// A status of a call that is documented for it, beside those that any call may return.
void check_documented(const char *call, tetlod_status status, std::initializer_list<tetlod_status> documented);

class Session {
 public:
  explicit Session(const Conditions &conditions);
  /// Nothing is left behind.
  ~Session();
  Session(const Session &) = delete;
  Session &operator=(const Session &) = delete;

  tetlod_context *context() const { return context_; }
  bool has_result() const { return bool(last_); }
  const Fetched &last() const { return *last_; }
  std::uint64_t last_hash() const { return hash_; }

  // Slots. The blocks live as long as the session: the library borrows.
  void submit_all(const Mesh &mesh);
  void submit_points(const Mesh &mesh, Bytes &in);
  void submit_tets(const Mesh &mesh, Bytes &in);
  void submit_values(const Mesh &mesh, Bytes &in);
  /// Packed, in the widest types, with this index base.
  void submit_plain(const Mesh &mesh, std::int32_t base);
  std::int32_t base() const { return base_; }
  void submit_field(Bytes &in);
  void submit_steering(Bytes &in);
  void submit_flags(Bytes &in);
  void clear();
  bool complete() const { return points_ && tets_ && values_; }

  /// What the slots say, as far as it makes a mesh.
  Mesh mesh() const;

  void set(const Setting &setting);
  double option(std::int32_t number) const;
  bool takes_contacts() const;
  bool has_target() const { return option(TETLOD_OPT_TARGET_RATIO) > 0 || option(TETLOD_OPT_MAX_ERROR) > 0; }

  tetlod_status run(const Disturbance &disturbance);
  /// After a run that has met a target ratio: what one of another leaves in the context does not show in the bytes.
  void run_another_size_between(double ratio);
  /// Counts of defects, and a verdict that the run after it bears out.
  void check(const Disturbance &disturbance);
  void estimate(const Disturbance &disturbance);

  // Of the fields, into any layout and room.
  void fetch_field(Bytes &in);
  void fetch_stencil(Bytes &in);
  void transfer(Bytes &in);
  void stencil_was_found() { stencil_known_ = true; }

  /// The result is the one that the last successful run gave.
  void check_kept();
  std::string message() const;

 private:
  struct Callbacks;
  struct Field {
    std::string name;
    std::int32_t association;
    Block *values;
    double weight = 0;  ///< positive: it steers
  };
  /// What became of a field in the last successful run.
  struct Carried {
    Field field;
    std::vector<double> values;
  };

  tetlod_status disturbed(const Disturbance &disturbance, const std::function<tetlod_status()> &call);
  void check_trouble(const char *call, tetlod_status status, const Disturbance &disturbance) const;
  void check_verdict(tetlod_status status, const Mesh &mesh, const Facts &facts) const;
  void accept(const Mesh &mesh, const Facts &facts);
  void check_report(const Mesh &mesh, const Facts &facts) const;
  bool repairs(std::int32_t policy) const;  ///< TETLOD_OPT_ON_...
  bool policies_repair() const;             ///< all of those whose defects a sound mesh may have
  bool undisturbed_success_expected(const Mesh &mesh) const;
  void check_target() const;

  void withdraw(const std::string &name);
  bool forget_field(const std::string &name);
  std::vector<std::pair<std::string, Block *>> steering() const;
  void check_steered(const Carried &field) const;
  bool fields_fit() const;
  bool flags_fit() const;
  std::vector<double> carried(const Field &field) const;
  Stencil stencil() const;
  tetlod_status stencil_status() const;
  bool explains_limit(tetlod_status status) const;
  bool explains_refusal(tetlod_status status) const;
  void accept_fields(const Mesh &mesh);
  void check_carried_kept() const;
  void check_stencil(const Mesh &mesh, const Stencil &stencil) const;
  void check_point_field(const Stencil &stencil, const Carried &carried) const;
  void check_cell_fields() const;
  void check_flags(const Mesh &mesh, const Facts &facts) const;

  Conditions conditions_;
  Allocator allocator_;
  int files_before_ = 0;
  bool children_before_ = false;  ///< libFuzzer has one at times
  tetlod_context *context_ = nullptr;
  std::vector<std::unique_ptr<Block>> blocks_;
  Block *points_ = nullptr, *tets_ = nullptr, *values_ = nullptr, *flags_ = nullptr;
  std::int32_t base_ = 0;
  std::vector<Field> fields_;
  long sound_points_ = 0, sound_tets_ = 0, sound_values_ = 0;  ///< of which sound mesh they are
  std::optional<Fetched> last_;
  std::vector<Carried> carried_;
  Block *last_points_ = nullptr, *last_tets_ = nullptr, *last_values_ = nullptr;  ///< the input of last_
  std::int32_t last_base_ = 0;
  std::vector<std::pair<std::string, Block *>> last_steering_;
  bool stencil_known_ = false;  ///< no array is read for it any more
  std::uint64_t hash_ = 0;
  std::string said_;  ///< the message of the last call that worked
  long fired_ = 0;    ///< disturbances that came to pass in the last call
};

/// What the views show.
Fetched fetch(const tetlod_context *context);
bool same(const Fetched &a, const Fetched &b);

}  // namespace fuzz

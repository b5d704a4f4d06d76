// The first stages of a run, the cheap ones: what needs neither decimation nor remeshing.
#pragma once
#include "budget.hpp"
#include "prepared.hpp"
#include "stage_timer.hpp"

namespace tetlod {

class Beginning {
 public:
  Beginning(const Input &input, const Options &options, Prepared &prepared, Job &job, Result &result)
      : input_(input), options_(options), prepared_(prepared), job_(job), result_(result), report_(result.report) {}

  void begin();

 protected:
  /// Of the error at what points became, so that it holds for each of them; 0: none.
  double bound() const;
  /// Of the boundary from the original's as it was moved, so that it holds for the submitted one; 0: none.
  double deviation_limit() const;
  /// Throws Status::max_error where no value is so near to those of points that became one.
  void refuse_spread() const;
  void sample();
  void select();

  template <class Sampling>
  void sample_by(const Sampling &sampling) {
    const StageTimer timer(Stage::sample, job_, report_);
    sampling();
    report_.selected_samples = std::int64_t(selected_.size());
  }

  const Input &input_;
  const Options &options_;
  Prepared &prepared_;
  Job &job_;
  Result &result_;
  Report &report_;
  Budget budget_;
  Original &original_{prepared_.original};
  Boundary &boundary_{prepared_.boundary};
  Array<std::int32_t> selected_{&job_.memory};  // by sampling

 private:
  void tell_unequal_fields() const;
  void tell_moves() const;
  void prepare();
  void extract();
};

}  // namespace tetlod

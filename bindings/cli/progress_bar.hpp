// A line on stderr that says how far the run is; nothing where stderr is not a terminal.
#pragma once

class vtkObject;

namespace cli {

class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar &) = delete;
  ProgressBar &operator=(const ProgressBar &) = delete;

  void show(const char *what, double fraction);
  void clear();
  // Observes a filter's ProgressEvent. Aborts it after an interruption.
  void on_progress(vtkObject *filter, unsigned long, void *);

 private:
  bool on_;
  bool drawn_ = false;
};

}  // namespace cli

#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <ostream>
#include <string>

namespace croon {

/// How progress is shown.
enum class ProgressStyle {
  none,  ///< Not at all (--quiet).
  bar,   ///< One line that is redrawn: for a terminal.
  lines  ///< A line every 10 s or 10 %, whichever comes first: for a log.
};

/// `none` if `quiet`, `bar` if standard error is a terminal, else `lines`.
ProgressStyle progress_style_of_stderr(bool quiet);

/// Shows the progress of a run: done, total, rate, time left. Thread-safe.
class Progress {
 public:
  /// Seconds since some fixed point.
  using Clock = std::function<double()>;

  /// Writes to `out`, which must outlive it; `total` is the number of trials to do.
  Progress(std::ostream& out, ProgressStyle style, std::size_t total, Clock clock = steady_seconds);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Sets the scene that is shown as being processed.
  void set_scene(const std::string& scene);
  /// `count` more trials are done.
  void advance(std::size_t count = 1);
  /// Counts trials that need no work (the store has them): done, but not part of the rate.
  void skip(std::size_t count);
  /// Draws the last state and ends the line. The destructor calls it too.
  void finish();

  /// The steady clock of the machine.
  static double steady_seconds();

 private:
  void show_if_due();
  void show(double now_s);
  std::string state(double now_s) const;

  std::ostream& out_;
  ProgressStyle style_;
  std::size_t total_;
  Clock clock_;
  std::mutex mutex_;
  double start_s_;
  double shown_s_;
  std::size_t done_ = 0;
  std::size_t skipped_ = 0;
  std::size_t shown_done_ = 0;
  std::size_t shown_columns_ = 0;
  bool is_finished_ = false;
  std::string scene_;
};

}  // namespace croon

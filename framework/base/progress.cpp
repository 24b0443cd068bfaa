#include "framework/base/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "framework/base/text.hpp"

namespace croon {

namespace {

constexpr double kRedraw_s = 0.1;
constexpr double kLine_s = 10.0;
constexpr std::size_t kLinesPerRun = 10;
constexpr std::size_t kBarColumns = 24;
constexpr std::size_t kLineColumns = 79;  // Fits every terminal without wrapping.

std::string bar_text(std::size_t done, std::size_t total) {
  const std::size_t filled = total == 0 ? kBarColumns : std::min(done, total) * kBarColumns / total;
  return "[" + std::string(filled, '#') + std::string(kBarColumns - filled, '.') + "] ";
}

}  // namespace

ProgressStyle progress_style_of_stderr(bool quiet) {
  if (quiet) return ProgressStyle::none;
  return isatty(STDERR_FILENO) != 0 ? ProgressStyle::bar : ProgressStyle::lines;
}

double Progress::steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Progress::Progress(std::ostream& out, ProgressStyle style, std::size_t total, Clock clock)
    : out_(out), style_(style), total_(total), clock_(std::move(clock)) {
  start_s_ = shown_s_ = clock_();
}

Progress::~Progress() { finish(); }

void Progress::set_scene(const std::string& scene) {
  const std::lock_guard<std::mutex> lock(mutex_);
  scene_ = scene;
  show_if_due();
}

void Progress::advance(std::size_t count) {
  const std::lock_guard<std::mutex> lock(mutex_);
  done_ += count;
  show_if_due();
}

void Progress::skip(std::size_t count) {
  const std::lock_guard<std::mutex> lock(mutex_);
  done_ += count;
  skipped_ += count;
  show_if_due();
}

void Progress::finish() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_finished_) return;
  is_finished_ = true;
  if (style_ == ProgressStyle::none) return;
  show(clock_());
  if (style_ == ProgressStyle::bar) out_ << '\n' << std::flush;
}

void Progress::show_if_due() {
  if (style_ == ProgressStyle::none || is_finished_) return;
  const double now_s = clock_();
  const double since_s = now_s - shown_s_;
  const bool is_tenth = done_ * kLinesPerRun / std::max<std::size_t>(total_, 1) >
                        shown_done_ * kLinesPerRun / std::max<std::size_t>(total_, 1);
  // finish() shows the final state in either style.
  if (style_ == ProgressStyle::bar ? since_s >= kRedraw_s
                                   : (since_s >= kLine_s || is_tenth) && done_ < total_) {
    show(now_s);
  }
}

void Progress::show(double now_s) {
  shown_s_ = now_s;
  shown_done_ = done_;
  if (style_ == ProgressStyle::lines) {
    out_ << state(now_s) << '\n' << std::flush;
    return;
  }
  const std::string line = cut_to_columns(bar_text(done_, total_) + state(now_s), kLineColumns);
  out_ << '\r' << left_aligned(line, shown_columns_) << std::flush;
  shown_columns_ = text_columns(line);
}

std::string Progress::state(double now_s) const {
  const double elapsed_s = now_s - start_s_;
  const auto worked = static_cast<double>(done_ - skipped_);
  std::string text = std::to_string(done_) + "/" + std::to_string(total_);
  if (worked > 0.0 && elapsed_s > 0.0) {
    const double rate = worked / elapsed_s;
    text += "  " + fixed_number(rate, rate < 10.0 ? 2 : 0) + "/s";
    if (done_ < total_) {
      text += "  " + clock_text(static_cast<double>(total_ - done_) / rate) + " to go";
    }
  }
  if (is_finished_) return text + "  in " + clock_text(elapsed_s);
  return scene_.empty() ? text : text + "  " + scene_;
}

}  // namespace croon

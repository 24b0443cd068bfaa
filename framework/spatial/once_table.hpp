#pragma once

#include <any>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace croon {

/// A computation that was done once and its wall time, for the rows of timings.csv with trial -1.
struct OnceTiming {
  std::string what;
  double seconds = 0.0;
};

/// The log of what a cloud and the clouds derived from it computed once. Thread-safe.
class OnceLog {
 public:
  void add(OnceTiming timing);
  std::vector<OnceTiming> timings() const;

 private:
  mutable std::mutex mutex_;
  std::vector<OnceTiming> timings_;
};

/// The seconds that this thread has spent so far inside OnceTable::get of tables with a log:
/// computing shared values or waiting for them. A step's own time is its wall time minus the growth
/// of this number.
double seconds_spent_on_shared_work();

/// A cache of values that depend on a cloud alone, each computed on first use. Thread-safe: one
/// thread computes a value, and others that ask for it wait. An exception is stored and rethrown at
/// every later call.
class OnceTable {
 public:
  /// Writes each computation to `log`, its name with `prefix` in front. If `log` is null, the
  /// values are not shared between trials, and the time counts as the asking step's own.
  OnceTable(std::shared_ptr<OnceLog> log, std::string prefix)
      : log_(std::move(log)), prefix_(std::move(prefix)) {}

  /// The value called `what` for these `parameters`; `make` computes it at the first call. A pair
  /// of `what` and `parameters` always has the same type T; the log calls it `what`.
  template <class T>
  std::shared_ptr<const T> get(const std::string& what, const std::string& parameters,
                               const std::function<std::shared_ptr<const T>()>& make) const {
    return std::any_cast<std::shared_ptr<const T>>(
        get_any(what, parameters, [&make] { return std::any(make()); }));
  }

 private:
  struct Entry {
    std::once_flag once;
    std::any value;
    std::exception_ptr error;
  };
  std::any get_any(const std::string& what, const std::string& parameters,
                   const std::function<std::any()>& make) const;

  std::shared_ptr<OnceLog> log_;
  std::string prefix_;
  mutable std::mutex mutex_;
  mutable std::map<std::pair<std::string, std::string>, std::shared_ptr<Entry>> entries_;
};

}  // namespace croon

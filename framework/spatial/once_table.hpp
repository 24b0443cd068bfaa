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

/// The name and wall time of a computation that ran once, for the rows of timings.csv with trial
/// -1.
struct OnceTiming {
  std::string what;
  double seconds = 0.0;
};

/// The log of the shared computations of a cloud and the clouds derived from it. Thread-safe.
class OnceLog {
 public:
  void add(OnceTiming timing);
  std::vector<OnceTiming> timings() const;

 private:
  mutable std::mutex mutex_;
  std::vector<OnceTiming> timings_;
};

/// The seconds that this thread has spent so far in OnceTable::get of tables with a log, computing
/// shared values or waiting for them. A step's own time is its wall time minus the increase of this
/// number.
double seconds_spent_on_shared_work();

/// A cache of values that depend only on a cloud, each computed on first use. Thread-safe: one
/// thread computes a value, and others that request it wait. An exception is stored and rethrown by
/// every later call.
class OnceTable {
 public:
  /// Logs each computation in `log`, with `prefix` before its name. If `log` is null, the values
  /// are not shared between trials, and the time counts as the requesting step's own.
  OnceTable(std::shared_ptr<OnceLog> log, std::string prefix)
      : log_(std::move(log)), prefix_(std::move(prefix)) {}

  /// The value called `what` for these `parameters`; `make` computes it in the first call. A pair
  /// of `what` and `parameters` always has the same type T; the log contains only `what`.
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

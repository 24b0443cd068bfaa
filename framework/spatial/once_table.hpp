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

/// What was computed once and how long that took, for the `-1` rows of timings.csv.
struct OnceTiming {
  std::string what;
  double seconds = 0.0;
};

/// What a cloud and the clouds that were made of it computed once, as it is done. Thread-safe.
class OnceLog {
 public:
  void add(OnceTiming timing);
  std::vector<OnceTiming> timings() const;

 private:
  mutable std::mutex mutex_;
  std::vector<OnceTiming> timings_;
};

/// Seconds that this thread has spent so far inside OnceTable::get: making things that others
/// share, or waiting for them. A step's own time is its wall time less the growth of this.
double seconds_spent_on_shared_work();

/// Things that depend on a cloud alone, each made when it is first asked for and then shared.
/// Thread-safe: one thread makes a thing, others that ask meanwhile wait. What throws is remembered
/// and thrown again.
class OnceTable {
 public:
  /// What is made goes to `log`, each thing's name behind `prefix`.
  OnceTable(std::shared_ptr<OnceLog> log, std::string prefix)
      : log_(std::move(log)), prefix_(std::move(prefix)) {}

  /// The thing that is `what` with these `parameters`, made by `make` at the first call. The two
  /// belong to one type; the log knows it as `what`.
  template <class T>
  std::shared_ptr<const T> get(const std::string& what, const std::string& parameters,
                               const std::function<std::shared_ptr<const T>()>& make) const {
    return std::any_cast<std::shared_ptr<const T>>(
        get_any(what, parameters, [&make] { return std::any(make()); }));
  }

 private:
  struct Entry {
    std::once_flag once;
    std::any thing;
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

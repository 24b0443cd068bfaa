#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "experiments/store/store.hpp"

namespace croon::experiments {

/// A result of a run: a trial with its timings, or the timings of what was done once for a scene.
struct Done {
  std::optional<TrialRecord> record;
  std::vector<TimingRow> timings;
};

/// Writes to a store from a thread of its own, so that trials do not wait for the disk. Results
/// that arrive during a commit are written in the next one. A kill loses what is not committed,
/// some milliseconds of work.
class StoreWriter {
 public:
  /// Calls `on_stored`, on the writer's thread, with results that are on disk.
  StoreWriter(Store& store, std::function<void(const std::vector<Done>&)> on_stored);
  /// Writes what is queued. Errors are lost, so call finish() before.
  ~StoreWriter();
  StoreWriter(const StoreWriter&) = delete;
  StoreWriter& operator=(const StoreWriter&) = delete;

  /// Queues `done`; waits if the queue is long. Throws what writing threw.
  void add(Done done);
  /// Returns when all is on disk. Throws what writing threw.
  void finish();

 private:
  void write_all();

  Store& store_;
  std::function<void(const std::vector<Done>&)> on_stored_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Done> queue_;
  std::exception_ptr error_;
  bool is_finished_ = false;
  std::thread thread_;
};

}  // namespace croon::experiments

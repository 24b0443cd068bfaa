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

/// A result of a run: a trial with its timings, or the timings of computations done once for a
/// scene.
struct Done {
  std::optional<TrialRecord> record;
  std::vector<TimingRow> timings;
};

/// Writes to a store from its own thread, so that trials do not wait for the disk. Results that
/// arrive during a commit are written in the next one. A kill loses uncommitted results, some
/// milliseconds of work.
class StoreWriter {
 public:
  /// Calls `on_stored` on the writer's thread with results that are on disk.
  StoreWriter(Store& store, std::function<void(const std::vector<Done>&)> on_stored);
  /// Writes the queued results. Errors are lost, so call finish() first.
  ~StoreWriter();
  StoreWriter(const StoreWriter&) = delete;
  StoreWriter& operator=(const StoreWriter&) = delete;

  /// Queues `done`; waits if the queue is full. Throws errors of writing.
  void add(Done done);
  /// Returns when everything is on disk. Throws errors of writing.
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

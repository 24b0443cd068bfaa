#include "experiments/store/store_writer.hpp"

#include <utility>

namespace croon::experiments {
namespace {

constexpr std::size_t kMaxQueued = 4096;

void store_records(Store& store, const std::vector<Done>& batch) {
  std::vector<const TrialRecord*> records;
  for (const Done& done : batch) {
    if (done.record) records.push_back(&*done.record);
  }
  if (!records.empty()) store.add(records);
}

}  // namespace

StoreWriter::StoreWriter(Store& store, std::function<void(const std::vector<Done>&)> on_stored)
    : store_(store), on_stored_(std::move(on_stored)), thread_([this] { write_all(); }) {}

StoreWriter::~StoreWriter() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_finished_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void StoreWriter::add(Done done) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [&] { return queue_.size() < kMaxQueued || error_; });
  if (error_) std::rethrow_exception(error_);
  queue_.push_back(std::move(done));
  changed_.notify_all();
}

void StoreWriter::finish() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_finished_ = true;
  }
  changed_.notify_all();
  thread_.join();
  if (error_) std::rethrow_exception(error_);
}

void StoreWriter::write_all() {
  while (true) {
    std::vector<Done> batch;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [&] { return !queue_.empty() || is_finished_; });
      if (queue_.empty()) return;
      batch.swap(queue_);
    }
    changed_.notify_all();
    try {
      store_records(store_, batch);
      on_stored_(batch);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      error_ = std::current_exception();
      queue_.clear();
      break;
    }
  }
  changed_.notify_all();
}

}  // namespace croon::experiments

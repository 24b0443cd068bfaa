#include "framework/spatial/once_table.hpp"

#include <tbb/task_arena.h>

#include <chrono>

namespace croon {
namespace {

thread_local double shared_work_s = 0.0;

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

double seconds_spent_on_shared_work() { return shared_work_s; }

void OnceLog::add(OnceTiming timing) {
  const std::lock_guard<std::mutex> lock(mutex_);
  timings_.push_back(std::move(timing));
}

std::vector<OnceTiming> OnceLog::timings() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return timings_;
}

std::any OnceTable::get_any(const std::string& what, const std::string& parameters,
                            const std::function<std::any()>& make) const {
  std::shared_ptr<Entry> entry;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::shared_ptr<Entry>& slot = entries_[{what, parameters}];
    if (!slot) slot = std::make_shared<Entry>();
    entry = slot;
  }
  const double spent_before = shared_work_s;
  const double start = now_s();
  std::call_once(entry->once, [&] {
    try {
      // Isolated: a thread that waits inside `make` must not pick up a task that requests this
      // entry.
      tbb::this_task_arena::isolate([&] { entry->value = make(); });
    } catch (...) {
      entry->error = std::current_exception();
    }
    if (log_) log_->add({prefix_ + what, now_s() - start - (shared_work_s - spent_before)});
  });
  // All of the wall time was shared work, including nested calls.
  if (log_) shared_work_s = spent_before + (now_s() - start);
  if (entry->error) std::rethrow_exception(entry->error);
  return entry->value;
}

}  // namespace croon

#include "framework/base/threads.hpp"

#include <tbb/info.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "framework/base/memory.hpp"

namespace croon {

int startable_threads(int jobs) {
  const int cores = tbb::info::default_concurrency();
  if (jobs <= cores) return jobs;
  // The stack, the 64 MB heap that malloc reserves per thread, and some work.
  constexpr double kThreadBytes = 1e8;
  jobs =
      std::max(1, static_cast<int>(std::min<double>(jobs, address_space_bytes() / kThreadBytes)));
  std::mutex mutex;
  std::condition_variable changed;
  bool may_end = false;
  std::vector<std::thread> threads;
  try {
    while (threads.size() < static_cast<std::size_t>(jobs)) {
      threads.emplace_back([&] {
        std::unique_lock<std::mutex> lock(mutex);
        changed.wait(lock, [&] { return may_end; });
      });
    }
  } catch (const std::system_error&) {
    // Fewer threads have to suffice.
  }
  {
    const std::lock_guard<std::mutex> lock(mutex);
    may_end = true;
  }
  changed.notify_all();
  for (std::thread& thread : threads) thread.join();
  const auto started = static_cast<int>(threads.size());
  // Half of them, because the work itself needs memory too.
  return started == jobs ? jobs : std::max(std::min(cores, jobs), started / 2);
}

}  // namespace croon

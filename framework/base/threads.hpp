#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstddef>

namespace croon {

/// The maximum number of threads that a user may request: more than the cores of any current
/// machine, but few enough to start within a few seconds.
inline constexpr int kMaxJobs = 1024;

/// The number of threads, out of `jobs`, that can be used: all of them, unless they outnumber the
/// cores and the system cannot start that many. TBB aborts the process if a thread does not start.
int startable_threads(int jobs);

/// Calls `use` with TBB limited to `asked_jobs` threads, which may exceed the number of cores, or
/// to fewer if the system cannot start that many.
template <class Use>
void on_threads(int asked_jobs, const Use& use) {
  const int jobs = startable_threads(asked_jobs);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(jobs));
  tbb::task_arena arena(jobs);
  arena.execute(use);
}

/// Calls `use(i)` for each i below `count`, each as a separate task.
template <class Use>
void for_each_in_parallel(std::size_t count, const Use& use) {
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) use(i);
      },
      tbb::simple_partitioner());
}

}  // namespace croon

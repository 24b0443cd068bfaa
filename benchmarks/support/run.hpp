#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <functional>
#include <string>

namespace croon::benchmarks {

/// The main function of a benchmark program: calls `check_and_add`, which verifies the results of
/// the code to be measured (throws if they are wrong) and registers the benchmarks, and runs them.
/// Returns the exit code: 1 if the check or a benchmark failed, 2 if an argument is unknown.
int run(int argc, char** argv, const std::function<void()>& check_and_add);

/// The number of bytes that the process has allocated with malloc or new and not freed.
std::size_t allocated_bytes();

/// Registers `measure` under `name`. Measures wall time, because a stage may use several threads.
/// An exception from `measure` marks it as failed.
void add(const std::string& name, benchmark::TimeUnit unit,
         const std::function<void(benchmark::State&)>& measure);

/// The same, but the time is what `measure` sets with `SetIterationTime`.
void add_with_own_clock(const std::string& name, benchmark::TimeUnit unit,
                        const std::function<void(benchmark::State&)>& measure);

}  // namespace croon::benchmarks

#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <functional>
#include <string>

namespace croon::benchmarks {

/// The main function of a benchmark program: calls `check_and_add`, which checks that what is to be
/// measured is right (throws where it is not) and registers the benchmarks, and runs them. Returns
/// the exit code: 1 where the check or a benchmark failed, 2 where an argument is unknown.
int run(int argc, char** argv, const std::function<void()>& check_and_add);

/// How many bytes the process has allocated and not freed, by malloc or new.
std::size_t allocated_bytes();

/// Registers `measure` under `name`. Wall time, because a stage may use more than one thread. What
/// `measure` throws ends it as failed.
void add(const std::string& name, benchmark::TimeUnit unit,
         const std::function<void(benchmark::State&)>& measure);

}  // namespace croon::benchmarks

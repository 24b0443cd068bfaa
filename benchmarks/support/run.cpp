#include "benchmarks/support/run.hpp"

#ifdef CROON_WITH_JEMALLOC
#include <jemalloc/jemalloc.h>
#else
#include <malloc.h>
#endif

#include <cstdint>
#include <exception>
#include <iostream>
#include <vector>

#include "framework/base/huge_pages.hpp"

namespace croon::benchmarks {
namespace {

int& failures() {
  static int count = 0;
  return count;
}

benchmark::internal::Benchmark* registered(const std::string& name, benchmark::TimeUnit unit,
                                           const std::function<void(benchmark::State&)>& measure) {
  return benchmark::RegisterBenchmark(name.c_str(),
                                      [measure](benchmark::State& state) {
                                        try {
                                          measure(state);
                                        } catch (const std::exception& error) {
                                          ++failures();
                                          state.SkipWithError(error.what());
                                        }
                                      })
      ->Unit(unit);
}

}  // namespace

std::size_t allocated_bytes() {
#ifdef CROON_WITH_JEMALLOC
  // Freed memory counts only after it leaves the thread's cache, and statistics are updated per
  // epoch.
  mallctl("thread.tcache.flush", nullptr, nullptr, nullptr, 0);
  std::uint64_t epoch = 1;
  mallctl("epoch", nullptr, nullptr, &epoch, sizeof(epoch));
  std::size_t bytes = 0;
  std::size_t size = sizeof(bytes);
  mallctl("stats.allocated", &bytes, &size, nullptr, 0);
  return bytes;
#else
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
#endif
}

void add(const std::string& name, benchmark::TimeUnit unit,
         const std::function<void(benchmark::State&)>& measure) {
  registered(name, unit, measure)->UseRealTime();
}

void add_with_own_clock(const std::string& name, benchmark::TimeUnit unit,
                        const std::function<void(benchmark::State&)>& measure) {
  registered(name, unit, measure)->UseManualTime();
}

int run(int argc, char** argv, const std::function<void()>& check_and_add) {
  // Short, so that all programs together take minutes; first, so that the caller's own flag takes
  // precedence.
  std::string min_time = "--benchmark_min_time=0.05";
  std::vector<char*> arguments(argv, argv + argc);
  arguments.insert(arguments.begin() + 1, min_time.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  try {
    check_and_add();
  } catch (const std::exception& error) {
    std::cerr << "not measured, because a check failed: " << error.what() << '\n';
    return 1;
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return failures() == 0 ? 0 : 1;
}

}  // namespace croon::benchmarks

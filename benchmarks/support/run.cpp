#include "benchmarks/support/run.hpp"

#include <malloc.h>

#include <exception>
#include <iostream>
#include <vector>

namespace croon::benchmarks {
namespace {

int& failures() {
  static int count = 0;
  return count;
}

}  // namespace

std::size_t allocated_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

void add(const std::string& name, benchmark::TimeUnit unit,
         const std::function<void(benchmark::State&)>& measure) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [measure](benchmark::State& state) {
                                 try {
                                   measure(state);
                                 } catch (const std::exception& error) {
                                   ++failures();
                                   state.SkipWithError(error.what());
                                 }
                               })
      ->Unit(unit)
      ->UseRealTime();
}

int run(int argc, char** argv, const std::function<void()>& check_and_add) {
  // Short, so that all programs together stay within minutes; first, so that the caller's own flag
  // wins.
  std::string min_time = "--benchmark_min_time=0.05";
  std::vector<char*> arguments(argv, argv + argc);
  arguments.insert(arguments.begin() + 1, min_time.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  try {
    check_and_add();
  } catch (const std::exception& error) {
    std::cerr << "not measured, because it is wrong: " << error.what() << '\n';
    return 1;
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return failures() == 0 ? 0 : 1;
}

}  // namespace croon::benchmarks

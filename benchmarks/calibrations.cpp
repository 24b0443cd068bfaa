// What does a complete calibration of two clouds cost, first without cached data, and then from
// another initial guess with cached trees, normals and grounds? How does the cost of `best.json`
// grow with the number of points?

#include "benchmarks/support/calibration.hpp"
#include "benchmarks/support/run.hpp"

namespace croon::benchmarks {
namespace {

constexpr std::size_t kWarmUps = 8;

void set_counters(benchmark::State& state, const AnswerErrors& errors, const CloudPair& pair) {
  errors.set_counters(state);
  state.counters["points"] = static_cast<double>(pair.target.size() + pair.source.size());
}

/// `trials` counts over repetitions, so that each starts from another initial guess.
void measure_first(benchmark::State& state, const Method& method, const CloudPair& pair,
                   std::size_t& trials) {
  Calibration calibration(method, pair);
  AnswerErrors errors;
  for (auto _ : state) {
    state.PauseTiming();
    calibration.forget();
    state.ResumeTiming();
    const Answer answer = calibration.run(trials++);
    state.PauseTiming();
    errors.add(answer, pair);
    state.ResumeTiming();
  }
  set_counters(state, errors, pair);
}

void measure_further(benchmark::State& state, const Method& method, const CloudPair& pair) {
  Calibration calibration(method, pair);
  std::size_t trials = 0;
  while (trials < kWarmUps) calibration.run(trials++);
  for (auto _ : state) benchmark::DoNotOptimize(calibration.run(trials++));
}

void add_first(const std::string& name, const Method& method, const CloudPair& pair) {
  add(name, benchmark::kMillisecond, [=, trials = std::size_t{0}](benchmark::State& state) mutable {
    measure_first(state, method, pair, trials);
  });
}

void check_and_add() {
  std::vector<CloudPair> pairs = {street(100000, 20000)};
  for (CloudPair& pair : samples()) pairs.push_back(std::move(pair));
  for (CloudPair& pair : rigs()) pairs.push_back(std::move(pair));
  for (const CloudPair& pair : pairs) {
    for (const Method& method : methods()) {
      add_first(pair.name + "/first_start/" + method.name, method, pair);
    }
    for (const Method& method : methods()) {
      add(pair.name + "/further_start/" + method.name, benchmark::kMillisecond,
          [=](benchmark::State& state) { measure_further(state, method, pair); });
    }
  }
  for (const int count : {10000, 30000, 100000, 300000, 1000000}) {
    const CloudPair pair = street(count, count);
    add_first("growth/" + pair.name + "/best", methods().back(), pair);
  }
}

}  // namespace
}  // namespace croon::benchmarks

int main(int argc, char** argv) {
  return croon::benchmarks::run(argc, argv, croon::benchmarks::check_and_add);
}

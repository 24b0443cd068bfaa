// What does a complete calibration of two clouds cost, first without cached data, and then from
// another initial guess with cached trees, normals and grounds?

#include <stdexcept>

#include "benchmarks/support/clouds.hpp"
#include "benchmarks/support/run.hpp"
#include "framework/pipeline/calibrate.hpp"
#include "framework/pipeline/rig.hpp"
#include "registry/registry.hpp"
#include "test/support/tree.hpp"

namespace croon::benchmarks {
namespace {

constexpr int kStarts = 8;

/// A pipeline, and the range of its initial guesses.
struct Method {
  std::string name, file;
  double rotation_deg;
};
const std::vector<Method> kMethods = {{"paper", "experiments/paper/pipeline.json", 45.0},
                                      {"best", "experiments/best.json", 180.0}};

class Calibration {
 public:
  Calibration(const Method& method, CloudPair pair)
      : pipeline_(load_pipeline(test::source_root() / method.file, registry())),
        pair_(std::move(pair)),
        starts_(poses_near(pair_, kStarts, method.rotation_deg, 0.1)) {
    forget();
  }

  /// Replaces the clouds by copies without cached data.
  void forget() {
    target_ = fresh(pair_.target);
    source_ = fresh(pair_.source);
  }

  /// Runs from the next initial guess. Throws if a step fails.
  void run() {
    Rig rig = {{"scene", "reference", "sensor", StreamKey(1),
                at_start(target_, source_, starts_[next_++ % starts_.size()])}};
    run_pipeline(pipeline_, rig, StreamKey(1));
    if (!rig[0].result.failure.empty()) throw std::runtime_error(rig[0].result.failure);
  }

 private:
  Pipeline pipeline_;
  CloudPair pair_;
  std::vector<RigidTransform> starts_;
  std::shared_ptr<const Cloud> target_, source_;
  std::size_t next_ = 0;
};

void measure_first(benchmark::State& state, Calibration calibration) {
  for (auto _ : state) {
    state.PauseTiming();
    calibration.forget();
    state.ResumeTiming();
    calibration.run();
  }
}

void measure_further(benchmark::State& state, Calibration calibration) {
  for (int i = 0; i < kStarts; ++i) calibration.run();
  for (auto _ : state) calibration.run();
}

void check_and_add() {
  std::vector<CloudPair> pairs = {street(100000, 20000)};
  for (CloudPair& pair : samples()) pairs.push_back(std::move(pair));
  for (const CloudPair& pair : pairs) {
    for (const Method& method : kMethods) {
      add(pair.name + "/first_start/" + method.name, benchmark::kMillisecond,
          [=](benchmark::State& state) { measure_first(state, Calibration(method, pair)); });
      add(pair.name + "/further_start/" + method.name, benchmark::kMillisecond,
          [=](benchmark::State& state) { measure_further(state, Calibration(method, pair)); });
    }
  }
}

}  // namespace
}  // namespace croon::benchmarks

int main(int argc, char** argv) {
  return croon::benchmarks::run(argc, argv, croon::benchmarks::check_and_add);
}

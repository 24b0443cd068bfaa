// What does one iteration of each registration cost, with cached normals?

#include "benchmarks/support/clouds.hpp"
#include "benchmarks/support/run.hpp"
#include "framework/stage/icp.hpp"
#include "test/support/stages.hpp"

namespace croon::benchmarks {
namespace {

constexpr int kPoses = 8;

/// The stage with one iteration at one distance, if it has these parameters.
params::Slot<Icp> one_iteration(const std::string& name) {
  const std::vector<std::pair<std::string, std::string>> wishes = {{"max_iterations", "1"},
                                                                   {"max_distances_m", "[0.5]"}};
  std::string json = R"({"type": ")" + name + "\"";
  for (const params::ParameterDoc& parameter : registry().find(Icp::kKind, name)->parameters) {
    for (const auto& [key, value] : wishes) {
      if (parameter.key == key) json += ", \"" + key + "\": " + value;
    }
  }
  return test::stage<Icp>(json + "}");
}

/// Starts from poses like the results of the rough calibration. All trials of a scene share its
/// clouds with their kd-trees and normals, so the first round over the poses is not timed.
void measure(benchmark::State& state, const params::Slot<Icp>& icp, const CloudPair& pair) {
  const auto target = fresh(pair.target);
  const auto source = fresh(pair.source);
  const std::vector<RigidTransform> poses = poses_near(pair, kPoses, 1.0, 0.1);
  Registration last;
  for (const RigidTransform& pose : poses) last = icp->align(*target, *source, pose);
  std::size_t next = 0;
  for (auto _ : state) {
    last = icp->align(*target, *source, poses[next++ % poses.size()]);
    benchmark::DoNotOptimize(last);
  }
  state.counters["iterations"] = static_cast<double>(last.iterations);
  state.counters["correspondences"] = static_cast<double>(last.correspondences);
}

void check_and_add() {
  std::vector<CloudPair> pairs = {street(20000, 5000), street(100000, 20000)};
  for (CloudPair& pair : samples()) pairs.push_back(std::move(pair));
  for (const CloudPair& pair : pairs) {
    for (const std::string& name : registry().names(Icp::kKind)) {
      add(pair.name + "/" + name, benchmark::kMillisecond,
          [icp = one_iteration(name), pair](benchmark::State& state) {
            measure(state, icp, pair);
          });
    }
  }
}

}  // namespace
}  // namespace croon::benchmarks

int main(int argc, char** argv) {
  return croon::benchmarks::run(argc, argv, croon::benchmarks::check_and_add);
}

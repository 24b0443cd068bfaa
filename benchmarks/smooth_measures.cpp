// What does a pose cost with the volume measures that do not count leaves?

#include <algorithm>

#include "benchmarks/support/clouds.hpp"
#include "benchmarks/support/run.hpp"
#include "test/support/leaf_scorers.hpp"

namespace croon::benchmarks {
namespace {

constexpr int kPoses = 32;

void measure(benchmark::State& state, const params::Slot<VolumeScorer>& scorer,
             const CloudPair& pair) {
  const VolumeFunction volume = scorer->bind(fresh(pair.target), fresh(pair.source));
  const std::vector<RigidTransform> poses = poses_near(pair, kPoses, 1.0, 0.1);
  std::size_t next = 0;
  for (auto _ : state) benchmark::DoNotOptimize(volume(poses[next++ % poses.size()]));
}

void check_and_add() {
  std::vector<CloudPair> pairs = {street(20000, 5000), street(100000, 20000)};
  for (const CloudPair& pair : samples()) pairs.push_back(non_ground(pair));
  const std::vector<std::string> of_leaves = test::leaf_scorer_names();
  for (const CloudPair& pair : pairs) {
    for (const std::string& name : registry().names(VolumeScorer::kKind)) {
      if (std::find(of_leaves.begin(), of_leaves.end(), name) != of_leaves.end()) continue;
      const auto scorer = test::stage<VolumeScorer>(R"({"type": ")" + name + R"("})");
      add(pair.name + "/" + name, benchmark::kMillisecond,
          [scorer, pair](benchmark::State& state) { measure(state, scorer, pair); });
    }
  }
}

}  // namespace
}  // namespace croon::benchmarks

int main(int argc, char** argv) {
  return croon::benchmarks::run(argc, argv, croon::benchmarks::check_and_add);
}

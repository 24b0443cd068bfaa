// What does a search for the pose of minimum volume cost, over all six degrees of freedom, with the
// fastest scorer?

#include "benchmarks/support/clouds.hpp"
#include "benchmarks/support/run.hpp"
#include "framework/stage/pose_search.hpp"
#include "framework/stage/volume_scorer.hpp"
#include "test/support/stages.hpp"

namespace croon::benchmarks {
namespace {

constexpr int kPoses = 8;

/// Starts from poses like the results of a registration. Includes binding, but the scorer's data of
/// the target is cached, as in all trials of a scene after the first.
void measure(benchmark::State& state, const params::Slot<PoseSearch>& search,
             const CloudPair& pair) {
  const auto scorer = test::stage<VolumeScorer>(R"({"type": "brick_hash"})");
  const auto target = fresh(pair.target);
  const auto source = fresh(pair.source);
  scorer->bind(target, source);
  const std::vector<RigidTransform> starts = poses_near(pair, kPoses, 0.2, 0.02);
  std::size_t next = 0;
  std::size_t evaluations = 0;
  for (auto _ : state) {
    const VolumeFunction volume = scorer->bind(target, source);
    const PoseMinimum found = search->minimise(volume_cost(volume), starts[next++ % starts.size()]);
    evaluations += static_cast<std::size_t>(found.evaluations);
  }
  state.counters["evaluations"] =
      static_cast<double>(evaluations) / static_cast<double>(state.iterations());
}

void check_and_add() {
  std::vector<CloudPair> pairs = {street(100000, 20000)};
  for (const CloudPair& pair : samples()) pairs.push_back(non_ground(pair));
  for (const CloudPair& pair : pairs) {
    for (const std::string& name : registry().names(PoseSearch::kKind)) {
      const auto search = test::stage<PoseSearch>(
          R"({"type": ")" + name + R"(", "dofs": ["roll", "pitch", "yaw", "x", "y", "z"]})");
      add(pair.name + "/" + name, benchmark::kMillisecond,
          [search, pair](benchmark::State& state) { measure(state, search, pair); });
    }
  }
}

}  // namespace
}  // namespace croon::benchmarks

int main(int argc, char** argv) {
  return croon::benchmarks::run(argc, argv, croon::benchmarks::check_and_add);
}

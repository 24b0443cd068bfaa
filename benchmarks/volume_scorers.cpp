// What does the occupied volume cost: to bind a scorer to two clouds, and then per pose?

#include <cstdlib>
#include <stdexcept>

#include "benchmarks/support/clouds.hpp"
#include "benchmarks/support/run.hpp"
#include "framework/params/values.hpp"
#include "framework/spatial/leaf_window.hpp"
#include "test/support/leaf_scorers.hpp"

namespace croon::benchmarks {
namespace {

using Scorer = params::Slot<VolumeScorer>;

constexpr int kPoses = 32;
constexpr int kBatch = 64;
const std::vector<double> kLeafSizes = {0.02, 0.05, 0.1, 0.2};

/// Options of which each costs a pose more than once, beside the leaf size.
const std::vector<std::pair<std::string, int>> kOptions = {
    {"lattices", 8}, {"leaf_sizes", 3}, {"min_points", 2}};

Scorer scorer(const std::string& name, double leaf_size_m, const std::string& option = "") {
  return test::stage<VolumeScorer>(R"({"type": ")" + name + R"(", "leaf_size_m": )" +
                                   params::value_json(leaf_size_m) + option + "}");
}

std::string option_json(const std::pair<std::string, int>& option) {
  return R"(, ")" + option.first + R"(": )" + params::value_json(option.second);
}

std::vector<std::int64_t> counts(const Scorer& scorer, const CloudPair& pair) {
  const VolumeFunction volume = scorer->bind(fresh(pair.target), fresh(pair.source));
  std::vector<std::int64_t> counts;
  const int poses = pair.source.size() > 500000 ? 2 : kPoses;
  for (const RigidTransform& pose : poses_near(pair, poses, 1.0, 0.1)) {
    counts.push_back(volume(pose).leaves);
  }
  return counts;
}

/// Times mean nothing where the answers differ.
void check_equal_counts(const std::vector<std::string>& names, const CloudPair& pair,
                        double leaf_size_m, const std::string& option = "") {
  const std::vector<std::int64_t> expected = counts(scorer(names.at(0), leaf_size_m, option), pair);
  for (const std::string& name : names) {
    if (counts(scorer(name, leaf_size_m, option), pair) != expected) {
      throw std::runtime_error(name + " and " + names[0] + " count differently on " + pair.name +
                               " at " + params::value_json(leaf_size_m) + " m");
    }
  }
}

/// Both clouds are new in every iteration: what a scorer makes of the target once is part of the
/// price.
void measure_bind(benchmark::State& state, const Scorer& scorer, const CloudPair& pair) {
  std::shared_ptr<const Cloud> target, source;
  VolumeFunction volume;
  for (auto _ : state) {
    state.PauseTiming();
    volume = {};
    target = fresh(pair.target);
    source = fresh(pair.source);
    state.ResumeTiming();
    volume = scorer->bind(target, source);
  }
  state.counters["target_points"] = static_cast<double>(pair.target.size());
}

void measure_pose(benchmark::State& state, const Scorer& scorer, const CloudPair& pair) {
  const VolumeFunction volume = scorer->bind(fresh(pair.target), fresh(pair.source));
  const std::vector<RigidTransform> poses = poses_near(pair, kPoses, 1.0, 0.1);
  std::size_t next = 0;
  for (auto _ : state) benchmark::DoNotOptimize(volume(poses[next++ % poses.size()]));
  state.counters["source_points"] = static_cast<double>(pair.source.size());
  state.counters["leaves"] = static_cast<double>(volume(pair.T_target_source).leaves);
}

/// The time of one pose of a batch, which the scorer may spread over all cores.
void measure_batch(benchmark::State& state, const Scorer& scorer, const CloudPair& pair) {
  const VolumeFunction volume = scorer->bind(fresh(pair.target), fresh(pair.source));
  const std::vector<RigidTransform> poses = poses_near(pair, kBatch, 1.0, 0.1);
  for (auto _ : state) benchmark::DoNotOptimize(volume.at(poses));
  state.counters["poses"] = static_cast<double>(poses.size());
  state.counters["per_pose"] = benchmark::Counter(
      static_cast<double>(poses.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// What no scorer can do without: the points at the pose, and the keys of their leaves.
void measure_floor(benchmark::State& state, const CloudPair& pair, double leaf_size_m) {
  const PointColumns points(pair.source);
  const LeafWindow window(LeafGrid(leaf_size_m), pair.T_target_source.translation);
  const std::vector<RigidTransform> poses = poses_near(pair, kPoses, 1.0, 0.1);
  std::size_t next = 0;
  for (auto _ : state) {
    window.for_each_block(points, poses[next++ % poses.size()],
                          [](const std::uint64_t* keys, std::size_t count) {
                            benchmark::DoNotOptimize(keys[count - 1]);
                          });
  }
  state.counters["source_points"] = static_cast<double>(pair.source.size());
}

void check_and_add_options(const std::vector<std::string>& names, const CloudPair& pair) {
  constexpr double kLeafSize = 0.05;
  for (const auto& option : kOptions) {
    check_equal_counts(names, pair, kLeafSize, option_json(option));
    for (const std::string& name : names) {
      const Scorer subject = scorer(name, kLeafSize, option_json(option));
      add("options/" + pair.name + "/leaf_size_m:0.05/" + option.first + ":" +
              params::value_json(option.second) + "/" + name,
          benchmark::kMillisecond,
          [=](benchmark::State& state) { measure_pose(state, subject, pair); });
    }
  }
}

void check_and_add() {
  std::vector<CloudPair> pairs;
  std::vector<int> sizes = {2000, 5000, 20000, 100000};
  // Minutes, so only on request.
  const char* most_points = std::getenv("CROON_BENCHMARK_POINTS");
  if (most_points != nullptr) {
    for (int count = 1000000; count <= std::atoi(most_points); count *= 10) sizes.push_back(count);
  }
  for (const int count : sizes) pairs.push_back(street(count, count));
  for (CloudPair& pair : samples()) {
    pairs.push_back(non_ground(pair));
    pair.name += "_with_ground";
    pairs.push_back(std::move(pair));
  }
  const std::vector<std::string> names = test::leaf_scorer_names();
  check_and_add_options(names, pairs.back());
  for (const CloudPair& pair : pairs) {
    for (const double leaf_size_m : kLeafSizes) {
      check_equal_counts(names, pair, leaf_size_m);
      add("floor/" + pair.name + "/leaf_size_m:" + params::value_json(leaf_size_m) + "/keys",
          benchmark::kMillisecond,
          [=](benchmark::State& state) { measure_floor(state, pair, leaf_size_m); });
      for (const std::string& name : names) {
        const Scorer subject = scorer(name, leaf_size_m);
        const std::string place =
            pair.name + "/leaf_size_m:" + params::value_json(leaf_size_m) + "/" + name;
        add("bind/" + place, benchmark::kMillisecond,
            [=](benchmark::State& state) { measure_bind(state, subject, pair); });
        add("pose/" + place, benchmark::kMillisecond,
            [=](benchmark::State& state) { measure_pose(state, subject, pair); });
        add("batch/" + place, benchmark::kMillisecond,
            [=](benchmark::State& state) { measure_batch(state, subject, pair); });
      }
    }
  }
}

}  // namespace
}  // namespace croon::benchmarks

int main(int argc, char** argv) {
  return croon::benchmarks::run(argc, argv, croon::benchmarks::check_and_add);
}

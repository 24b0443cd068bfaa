// What does the occupied volume cost, for binding a scorer to two clouds and then per pose?

#include <algorithm>
#include <stdexcept>
#include <thread>

#include "benchmarks/support/clouds.hpp"
#include "benchmarks/support/run.hpp"
#include "framework/base/threads.hpp"
#include "framework/params/values.hpp"
#include "framework/spatial/leaf_window.hpp"
#include "test/support/leaf_scorers.hpp"

namespace croon::benchmarks {
namespace {

using Scorer = params::Slot<VolumeScorer>;

constexpr int kPoses = 32;
constexpr int kBatch = 64;
const std::vector<double> kLeafSizes = {0.02, 0.05, 0.1, 0.2, 0.5};
const std::vector<double> kLeafSizesOfLarge = {0.05, 0.1};

/// Options that multiply the cost of a pose, besides the leaf size.
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
  const int poses = is_large(pair) ? 2 : kPoses;
  for (const RigidTransform& pose : poses_near(pair, poses, 1.0, 0.1)) {
    counts.push_back(volume(pose).leaves);
  }
  return counts;
}

/// Throws if the counts differ, where times would be meaningless.
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

/// Both clouds are new in every iteration, so that time and memory include the data that a scorer
/// caches of the target.
void measure_bind(benchmark::State& state, const Scorer& scorer, const CloudPair& pair) {
  std::shared_ptr<const Cloud> target, source;
  VolumeFunction volume;
  std::size_t before = 0;
  for (auto _ : state) {
    state.PauseTiming();
    volume = {};
    target = fresh(pair.target);
    source = fresh(pair.source);
    before = allocated_bytes();
    state.ResumeTiming();
    volume = scorer->bind(target, source);
  }
  state.counters["memory_bytes"] = static_cast<double>(allocated_bytes() - before);
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

/// Measures the time per pose in a batch, which the scorer may distribute over all cores.
void measure_batch(benchmark::State& state, const Scorer& scorer, const CloudPair& pair) {
  const VolumeFunction volume = scorer->bind(fresh(pair.target), fresh(pair.source));
  const std::vector<RigidTransform> poses = poses_near(pair, kBatch, 1.0, 0.1);
  for (auto _ : state) benchmark::DoNotOptimize(volume.at(poses));
  state.counters["poses"] = static_cast<double>(poses.size());
  state.counters["per_pose"] = benchmark::Counter(
      static_cast<double>(poses.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Measures all poses of a batch on a given number of threads.
void measure_threads(benchmark::State& state, const Scorer& scorer, const CloudPair& pair,
                     int threads) {
  const VolumeFunction volume = scorer->bind(fresh(pair.target), fresh(pair.source));
  const std::vector<RigidTransform> poses = poses_near(pair, kBatch, 1.0, 0.1);
  on_threads(threads, [&] {
    for (auto _ : state) benchmark::DoNotOptimize(volume.at(poses));
  });
}

/// Measures the lower bound for any scorer: transforming the points and computing the keys of their
/// leaves.
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

/// Measures the limit of the memory: reading and summing the coordinates of all points.
void measure_reading(benchmark::State& state, const CloudPair& pair) {
  const PointColumns points(pair.source);
  for (auto _ : state) {
    std::uint32_t sum = 0;
    for (const std::vector<float>* const column : {&points.x, &points.y, &points.z}) {
      // As integers: a sum of floats would be slower, because the compiler must not reorder it.
      const auto* const bits = reinterpret_cast<const std::uint32_t*>(column->data());
      for (std::size_t i = 0; i < column->size(); ++i) sum += bits[i];
    }
    benchmark::DoNotOptimize(sum);
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

/// Powers of two, and all cores.
std::vector<int> numbers_of_threads() {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  std::vector<int> numbers;
  for (int threads = 1; threads < cores; threads *= 2) numbers.push_back(threads);
  numbers.push_back(cores);
  return numbers;
}

void add_threads(const std::vector<std::string>& names, const CloudPair& pair) {
  for (const int threads : numbers_of_threads()) {
    for (const std::string& name : names) {
      const Scorer subject = scorer(name, 0.05);
      add("batch_of_64/" + pair.name + "/leaf_size_m:0.05/threads:" + std::to_string(threads) +
              "/" + name,
          benchmark::kMillisecond,
          [=](benchmark::State& state) { measure_threads(state, subject, pair, threads); });
    }
  }
}

void check_and_add() {
  std::vector<CloudPair> pairs = streets();
  for (CloudPair& pair : samples()) {
    pairs.push_back(non_ground(pair));
    pair.name += "_with_ground";
    pairs.push_back(std::move(pair));
  }
  const std::vector<std::string> names = test::leaf_scorer_names();
  const CloudPair& last = *std::find_if_not(pairs.rbegin(), pairs.rend(),
                                            [](const auto& one) { return is_large(one); });
  check_and_add_options(names, last);
  add_threads(names, last);
  for (const CloudPair& pair : pairs) {
    for (const double leaf_size_m : is_large(pair) ? kLeafSizesOfLarge : kLeafSizes) {
      check_equal_counts(names, pair, leaf_size_m);
      const std::string floor =
          "floor/" + pair.name + "/leaf_size_m:" + params::value_json(leaf_size_m);
      add(floor + "/reading", benchmark::kMillisecond,
          [=](benchmark::State& state) { measure_reading(state, pair); });
      add(floor + "/keys", benchmark::kMillisecond,
          [=](benchmark::State& state) { measure_floor(state, pair, leaf_size_m); });
      for (const std::string& name : names) {
        const Scorer subject = scorer(name, leaf_size_m);
        const std::string place =
            pair.name + "/leaf_size_m:" + params::value_json(leaf_size_m) + "/" + name;
        add("bind/" + place, benchmark::kMillisecond,
            [=](benchmark::State& state) { measure_bind(state, subject, pair); });
        add("pose/" + place, benchmark::kMillisecond,
            [=](benchmark::State& state) { measure_pose(state, subject, pair); });
        if (is_large(pair)) continue;
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

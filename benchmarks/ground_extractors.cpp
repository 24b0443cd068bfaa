// What does it cost to find the ground of one cloud?

#include <algorithm>

#include "benchmarks/support/clouds.hpp"
#include "benchmarks/support/run.hpp"
#include "framework/stage/ground_extractor.hpp"
#include "test/support/stages.hpp"

namespace croon::benchmarks {
namespace {

using Extractor = params::Slot<GroundExtractor>;

Ground extracted(const Extractor& extractor, const Points& cloud) {
  Rng rng(StreamKey(1).with("ground"));
  return extractor->extract(cloud, rng);
}

void measure(benchmark::State& state, const Extractor& extractor, const Points& cloud) {
  Ground ground;
  for (auto _ : state) benchmark::DoNotOptimize(ground = extracted(extractor, cloud));
  const auto count = cloud.size() - static_cast<std::size_t>(std::count(ground.is_ground.begin(),
                                                                        ground.is_ground.end(), 0));
  state.counters["points"] = static_cast<double>(cloud.size());
  state.counters["ground_ratio"] = static_cast<double>(count) / static_cast<double>(cloud.size());
}

void check_and_add() {
  std::vector<std::pair<std::string, Points>> clouds;
  for (const int count : {5000, 20000, 100000}) {
    const CloudPair pair = street(count, count);
    clouds.emplace_back(pair.name, pair.target);
  }
  for (const CloudPair& pair : samples()) {
    clouds.emplace_back(pair.name.substr(0, pair.name.rfind('/')) + "/reference", pair.target);
    clouds.emplace_back(pair.name, pair.source);
  }
  for (const auto& [place, cloud] : clouds) {
    for (const std::string& name : registry().names(GroundExtractor::kKind)) {
      const auto extractor = test::stage<GroundExtractor>(R"({"type": ")" + name + R"("})");
      add(place + "/" + name, benchmark::kMillisecond,
          [extractor, points = cloud](benchmark::State& state) {
            measure(state, extractor, points);
          });
    }
  }
}

}  // namespace
}  // namespace croon::benchmarks

int main(int argc, char** argv) {
  return croon::benchmarks::run(argc, argv, croon::benchmarks::check_and_add);
}

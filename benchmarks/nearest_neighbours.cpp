// What does a nearest-neighbour query cost, and what do our result set and bound save over plain
// nanoflann?

#include <algorithm>
#include <stdexcept>

#include "benchmarks/support/clouds.hpp"
#include "benchmarks/support/nanoflann_peer.hpp"
#include "benchmarks/support/run.hpp"

namespace croon::benchmarks {
namespace {

constexpr int kNormalNeighbours = 40;
constexpr float kUnbounded = 1e9F;

/// Throws if a search returns a different distance than the peer.
void check_equal_distances(const Points& points, const Points& queries) {
  const KdTree tree(points);
  const NanoflannPeer peer(points);
  std::vector<Neighbour> ours, theirs;
  bool equal = true;
  for (const Eigen::Vector3f& query : queries) {
    for (const float bound_m : {0.3F, 2.0F, kUnbounded}) {
      const Neighbour a = tree.nearest(query, bound_m), b = peer.nearest(query, bound_m);
      const bool both = static_cast<bool>(a) && static_cast<bool>(b);
      const bool neither = !a && !b;
      equal = equal && (neither || (both && a.squared_distance_m2 == b.squared_distance_m2));
    }
    tree.nearest(query, kNormalNeighbours, ours);
    peer.nearest(query, kNormalNeighbours, theirs);
    equal = equal && ours.size() == theirs.size();
    std::sort(ours.begin(), ours.end(), [](const Neighbour& a, const Neighbour& b) {
      return a.squared_distance_m2 < b.squared_distance_m2;
    });
    for (std::size_t i = 0; equal && i < ours.size(); ++i) {
      equal = ours[i].squared_distance_m2 == theirs[i].squared_distance_m2;
    }
  }
  if (!equal) throw std::runtime_error("KdTree and nanoflann find different neighbours");
}

template <class Tree>
void add_build(const std::string& name, const Points& points) {
  add(name, benchmark::kMillisecond, [points](benchmark::State& state) {
    for (auto _ : state) {
      const Tree tree(points);
      benchmark::DoNotOptimize(&tree);
    }
  });
}

/// One query per iteration, in the order of the queries.
template <class Tree, class Search>
void add_queries(const std::string& name, const Points& points, const Points& queries,
                 const Search& search) {
  add(name, benchmark::kNanosecond, [=](benchmark::State& state) {
    const Tree tree(points);
    std::size_t next = 0;
    for (auto _ : state) {
      search(tree, queries[next]);
      next = next + 1 == queries.size() ? 0 : next + 1;
    }
  });
}

template <class Tree>
void add_tree(const std::string& name, const CloudPair& pair) {
  const std::string place = "/" + pair.name + "/";
  // Queries as in registrations (near the true pose) and as in the rough calibration (up to 45
  // degrees off).
  const Points near = transformed(pair.source, poses_near(pair, 1, 0.5, 0.05)[0]);
  const Points off = transformed(pair.source, poses_near(pair, 1, 45.0, 0.1)[0]);
  const auto within = [](float bound_m) {
    return [bound_m](const Tree& tree, const Eigen::Vector3f& query) {
      benchmark::DoNotOptimize(tree.nearest(query, bound_m));
    };
  };
  add_build<Tree>("kd_tree" + place + name, pair.target);
  add_queries<Tree>("nearest" + place + name, pair.target, near, within(kUnbounded));
  add_queries<Tree>("nearest_within_0.3m" + place + name, pair.target, near, within(0.3F));
  add_queries<Tree>("nearest_off" + place + name, pair.target, off, within(kUnbounded));
  add_queries<Tree>("nearest_off_within_2m" + place + name, pair.target, off, within(2.0F));
  add_queries<Tree>("40_nearest" + place + name, pair.target, pair.target,
                    [](const Tree& tree, const Eigen::Vector3f& query) {
                      thread_local std::vector<Neighbour> neighbours;
                      tree.nearest(query, kNormalNeighbours, neighbours);
                      benchmark::DoNotOptimize(neighbours.data());
                    });
}

void check_and_add() {
  std::vector<CloudPair> pairs = {street(100000, 20000)};
  for (CloudPair& pair : samples()) pairs.push_back(std::move(pair));
  for (const CloudPair& pair : pairs) {
    check_equal_distances(pair.target, transformed(pair.source, pair.T_target_source));
    add_tree<KdTree>("croon", pair);
    add_tree<NanoflannPeer>("peer_nanoflann", pair);
  }
}

}  // namespace
}  // namespace croon::benchmarks

int main(int argc, char** argv) {
  return croon::benchmarks::run(argc, argv, croon::benchmarks::check_and_add);
}

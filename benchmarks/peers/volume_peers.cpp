// What does the occupied volume cost with other libraries, and with the registered scorers, in one
// run? Built with -DCROON_BENCHMARK_PEERS=ON.

#include <octomap/OcTree.h>
#include <openvdb/openvdb.h>
#include <pcl/octree/octree_search.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <stdexcept>

#include "benchmarks/support/clouds.hpp"
#include "benchmarks/support/run.hpp"
#include "framework/params/values.hpp"
#include "test/support/leaf_scorers.hpp"

namespace croon::benchmarks {
namespace {

/// The number of leaves of both clouds at a pose, and the memory used for counting, without the
/// points.
struct Count {
  std::int64_t leaves = 0;
  std::size_t bytes = 0;  ///< Only if requested, because measuring it takes time.
};

/// A counting method, bound to clouds and a leaf size.
using Counter = std::function<Count(const RigidTransform&, bool with_bytes)>;

/// The bytes allocated since construction, if requested.
class Allocated {
 public:
  explicit Allocated(bool is_asked_for)
      : is_asked_for_(is_asked_for), before_(is_asked_for ? allocated_bytes() : 0) {}
  std::size_t bytes() const { return is_asked_for_ ? allocated_bytes() - before_ : 0; }

 private:
  bool is_asked_for_;
  std::size_t before_;
};

/// As in the code of the paper's authors (lidar2lidar, commit c0e1e2b): each pose inserts the
/// points of both clouds into a search octree. Its lattice begins at the first point, and its
/// points are float, so the counts differ slightly.
Counter pcl_octree(const CloudPair& pair, double leaf_size_m) {
  return [&pair, leaf_size_m](const RigidTransform& T, bool with_bytes) -> Count {
    const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZI>>();
    const auto add = [&](const Eigen::Vector3f& p) {
      pcl::PointXYZI point;
      point.getVector3fMap() = p;
      cloud->push_back(point);
    };
    for (const Eigen::Vector3f& point : pair.target) add(point);
    for (const Eigen::Vector3f& point : transformed(pair.source, T)) add(point);
    const Allocated allocated(with_bytes);
    pcl::octree::OctreePointCloudSearch<pcl::PointXYZI> octree(leaf_size_m);
    octree.setInputCloud(cloud);
    octree.addPointsFromInputCloud();
    return {static_cast<std::int64_t>(octree.getLeafCount()), allocated.bytes()};
  };
}

/// An occupancy map of both clouds for each pose, without merging nodes and without ray casting.
Counter octomap_tree(const CloudPair& pair, double leaf_size_m) {
  return [&pair, leaf_size_m](const RigidTransform& T, bool with_bytes) -> Count {
    const Allocated allocated(with_bytes);
    octomap::OcTree tree(leaf_size_m);
    const auto add = [&](const Eigen::Vector3d& p) {
      tree.updateNode(tree.coordToKey(p.x(), p.y(), p.z()), true, true);
    };
    for (const Eigen::Vector3f& point : pair.target) add(point.cast<double>());
    for (const Eigen::Vector3f& point : pair.source) add(T * point.cast<double>());
    return {static_cast<std::int64_t>(tree.getNumLeafNodes()), allocated.bytes()};
  };
}

/// A mask grid of both clouds for each pose, with the library's own transform.
Counter openvdb_plain(const CloudPair& pair, double leaf_size_m) {
  return [&pair, leaf_size_m](const RigidTransform& T, bool with_bytes) -> Count {
    const Allocated allocated(with_bytes);
    const auto grid = openvdb::MaskGrid::create();
    const auto transform = openvdb::math::Transform::createLinearTransform(leaf_size_m);
    auto accessor = grid->getAccessor();
    const auto add = [&](const Eigen::Vector3d& p) {
      accessor.setValueOn(transform->worldToIndexNodeCentered({p.x(), p.y(), p.z()}));
    };
    for (const Eigen::Vector3f& point : pair.target) add(point.cast<double>());
    for (const Eigen::Vector3f& point : pair.source) add(T * point.cast<double>());
    return {static_cast<std::int64_t>(grid->activeVoxelCount()), allocated.bytes()};
  };
}

Counter registered(const std::string& name, const CloudPair& pair, double leaf_size_m) {
  const auto scorer = test::stage<VolumeScorer>(R"({"type": ")" + name + R"(", "leaf_size_m": )" +
                                                params::value_json(leaf_size_m) + "}");
  const auto target = fresh(pair.target), source = fresh(pair.source);
  const Allocated allocated(true);
  const VolumeFunction volume = scorer->bind(target, source);
  const std::size_t bytes = allocated.bytes();
  return [volume, bytes](const RigidTransform& T, bool) -> Count {
    return {volume(T).leaves, bytes};
  };
}

/// Throws if a count differs too much from ours. PCL's lattice and rounding differ.
void check_counts(const std::string& name, const Counter& counter, const Counter& ours,
                  const CloudPair& pair, double bound_ratio) {
  for (const RigidTransform& pose : poses_near(pair, is_large(pair) ? 1 : 4, 1.0, 0.1)) {
    const auto count = static_cast<double>(counter(pose, false).leaves);
    const auto expected = static_cast<double>(ours(pose, false).leaves);
    if (std::abs(count - expected) > bound_ratio * expected) {
      throw std::runtime_error(name + " counts " + std::to_string(count) + " leaves of " +
                               std::to_string(expected) + " on " + pair.name);
    }
  }
}

void measure(benchmark::State& state, const Counter& counter, const CloudPair& pair) {
  const std::vector<RigidTransform> poses = poses_near(pair, 32, 1.0, 0.1);
  std::size_t next = 0;
  for (auto _ : state) benchmark::DoNotOptimize(counter(poses[next++ % poses.size()], false));
  const Count count = counter(pair.T_target_source, true);
  state.counters["leaves"] = static_cast<double>(count.leaves);
  state.counters["memory_bytes"] = static_cast<double>(count.bytes);
  state.counters["source_points"] = static_cast<double>(pair.source.size());
  state.counters["target_points"] = static_cast<double>(pair.target.size());
}

void check_and_add() {
  static std::vector<CloudPair> pairs = streets();
  for (CloudPair& pair : samples()) {
    pairs.push_back(non_ground(pair));
    pair.name += "_with_ground";
    pairs.push_back(std::move(pair));
  }
  for (const CloudPair& pair : pairs) {
    // With 2e7 points, PCL and OctoMap build trees for half a minute per pose.
    constexpr std::size_t kManyPoints = 5000000;
    const bool is_slow = pair.source.size() > kManyPoints;
    for (const double leaf_size_m : is_slow ? std::vector{0.1} : std::vector{0.05, 0.1}) {
      const std::string place =
          "pose/" + pair.name + "/leaf_size_m:" + params::value_json(leaf_size_m) + "/";
      const auto add_counter = [&](const std::string& name, const Counter& counter) {
        add(place + name, benchmark::kMillisecond,
            [=, &pair](benchmark::State& state) { measure(state, counter, pair); });
      };
      const Counter ours = registered("pointer_octree", pair, leaf_size_m);
      for (const std::string& name : test::leaf_scorer_names()) {
        const Counter counter = registered(name, pair, leaf_size_m);
        check_counts(name, counter, ours, pair, 0.0);
        add_counter(name, counter);
      }
      const std::vector<std::tuple<std::string, Counter, double>> peers = {
          {"peer_pcl_octree", pcl_octree(pair, leaf_size_m), 0.03},
          {"peer_octomap", octomap_tree(pair, leaf_size_m), 1e-4},
          {"peer_openvdb_plain", openvdb_plain(pair, leaf_size_m), 1e-4}};
      for (const auto& [name, counter, bound_ratio] : peers) {
        check_counts(name, counter, ours, pair, bound_ratio);
        add_counter(name, counter);
      }
    }
  }
}

}  // namespace
}  // namespace croon::benchmarks

int main(int argc, char** argv) {
  openvdb::initialize();
  return croon::benchmarks::run(argc, argv, croon::benchmarks::check_and_add);
}

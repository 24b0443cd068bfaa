#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "framework/geometry/measured_points.hpp"
#include "framework/spatial/leaf_numbering.hpp"
#include "framework/stage/preprocessor.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::preprocessor {
namespace {

struct Params {
  double leaf_size_m = 0.1;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::number("leaf_size_m", &Params::leaf_size_m, {1e-4, 1e4},
                     "Edge of the cubes, each of which keeps one point."),
  };
  return table;
}

/// The accumulated points of one leaf.
struct LeafSum {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double time_sum = 0.0;  ///< Of differences from the first point, in units of the channel.
  std::uint64_t points = 0;
};

class VoxelDownsample final : public Preprocessor {
 public:
  explicit VoxelDownsample(const Params& params) : grid_(params.leaf_size_m) {}

  PointCloud apply(const PointCloud& cloud) const override {
    LeafNumbering numbering;
    std::vector<LeafSum> leaves;  // In the order of their first points in the cloud.
    std::vector<std::size_t> first_points;
    const std::vector<std::uint32_t> measured = measured_points(cloud);
    const Channel* const time = find_channel(cloud, kTime);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d point = cloud.points[i].cast<double>();
      const auto number =
          static_cast<std::size_t>(numbering.number_of(leaf_key(grid_.leaf_of(point))));
      if (number == leaves.size()) {
        leaves.emplace_back();
        first_points.push_back(i);
      }
      LeafSum& leaf = leaves[number];
      leaf.sum += measured[i] * point;
      leaf.points += measured[i];
      if (time == nullptr) continue;
      leaf.time_sum += measured[i] * (time->value(i) - time->value(first_points[number]));
    }
    PointCloud thinned = selected(cloud, first_points);
    std::vector<std::uint32_t> counts(leaves.size());
    constexpr std::uint64_t kMaxCount = std::numeric_limits<std::uint32_t>::max();
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      counts[i] = static_cast<std::uint32_t>(std::min(leaves[i].points, kMaxCount));
      thinned.points[i] = (leaves[i].sum / static_cast<double>(leaves[i].points)).cast<float>();
    }
    set_channel(thinned, make_channel(kMeanOf, counts));
    if (time != nullptr) set_channel(thinned, mean_times(*time, leaves, first_points));
    return thinned;
  }

 private:
  /// The measurement time of each leaf's mean: under motion, a mean of points is where a point
  /// measured at their mean time would be.
  static Channel mean_times(const Channel& time, const std::vector<LeafSum>& leaves,
                            const std::vector<std::size_t>& first_points) {
    Channel means = {time.name, time.type, 1, {}};
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const double first = time.value(first_points[i]);
      double mean = first + leaves[i].time_sum / static_cast<double>(leaves[i].points);
      if (time.type.kind != ScalarKind::floating) mean = std::round(mean);
      // 64-bit integers are more precise than double.
      if (mean == first || !append_scalar(means.bytes, time.type, mean)) {
        means.bytes.append(time.bytes, first_points[i] * time.bytes_per_point(), time.type.size);
      }
    }
    return means;
  }

  LeafGrid grid_;
};

}  // namespace

StageEntry voxel_downsample() {
  return stage_entry<VoxelDownsample>(
      "voxel_downsample",
      "Replaces the points of each leaf by their mean, with their mean time and the other channels "
      "of the first of them, in the order of the cloud. The channel mean_of counts the points.",
      "croon", table(), 3);
}

}  // namespace croon::stages::preprocessor

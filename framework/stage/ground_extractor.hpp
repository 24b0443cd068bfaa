#pragma once

#include <cstdint>
#include <vector>

#include "framework/base/rng.hpp"
#include "framework/geometry/plane.hpp"
#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The ground of a cloud: its plane in the sensor's frame and the points on it.
struct Ground {
  Plane plane;
  std::vector<std::uint8_t> is_ground;  ///< One per point of the cloud: 1 for ground.
};

/// Finds the ground of one cloud (paper, rough calibration: the plane with the most points).
class GroundExtractor {
 public:
  using Kind = GroundExtractor;
  static constexpr const char* kKind = "ground_extractor";
  static constexpr const char* kKindSummary =
      "Finds the ground plane of a cloud and the points that lie on it.";
  static constexpr int kKindOrder = 30;
  virtual ~GroundExtractor() = default;

  /// The ground; its normal's sign is arbitrary. Draws only from `rng`. Throws StageError if no
  /// plane is found.
  virtual Ground extract(const PointCloud& cloud, Rng& rng) const = 0;
};

}  // namespace croon

#pragma once

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// Makes another cloud of a sensor's cloud: crops it, thins it. In the sensor's frame, metres.
class Preprocessor {
 public:
  using Kind = Preprocessor;
  static constexpr const char* kKind = "preprocessor";
  static constexpr const char* kKindSummary =
      "Makes another cloud of a cloud: crops it or thins it.";
  static constexpr int kKindOrder = 20;
  virtual ~Preprocessor() = default;

  /// The points that stay (or stand for those that do), in a fixed order.
  virtual PointCloud apply(const PointCloud& cloud) const = 0;
};

}  // namespace croon

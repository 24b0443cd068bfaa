#pragma once

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// Filters a sensor's cloud: crops it or thins it. In the sensor's frame, metres.
class Preprocessor {
 public:
  using Kind = Preprocessor;
  static constexpr const char* kKind = "preprocessor";
  static constexpr const char* kKindSummary = "Filters a cloud: crops it or thins it.";
  static constexpr int kKindOrder = 20;
  virtual ~Preprocessor() = default;

  /// The points that remain, or that represent those that remain, in a fixed order.
  virtual PointCloud apply(const PointCloud& cloud) const = 0;
};

}  // namespace croon

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

  /// The points that remain, or that represent those that remain, with their channels, in a fixed
  /// order. Throws StageError if a channel that the stage needs is missing.
  virtual PointCloud apply(const PointCloud& cloud) const = 0;
};

}  // namespace croon

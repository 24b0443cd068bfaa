#include "framework/stage/preprocessor.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::preprocessor {
namespace {

struct Params {
  double min_m = 1.0;
  double max_m = 200.0;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = [] {
    params::Table<Params> rows = {
        params::number("min_m", &Params::min_m, {0.0, 1e6},
                       "Minimum distance of points from the sensor; excludes the car itself."),
        params::number("max_m", &Params::max_m, {0.0, 1e6},
                       "Maximum distance of points from the sensor."),
    };
    rows.require([](const Params& params) { return params.min_m <= params.max_m; },
                 "min_m must not be above max_m");
    return rows;
  }();
  return table;
}

class RangeCrop final : public Preprocessor {
 public:
  explicit RangeCrop(const Params& params) : params_(params) {}

  PointCloud apply(const PointCloud& cloud) const override {
    return filtered(cloud, [&](std::size_t i) {
      const double range_m = cloud.points[i].cast<double>().norm();
      return range_m >= params_.min_m && range_m <= params_.max_m;
    });
  }

 private:
  Params params_;
};

}  // namespace

StageEntry range_crop() {
  return stage_entry<RangeCrop>("range_crop",
                                "Keeps the points whose distance from the sensor is within bounds.",
                                "CROON's public code (lidar2lidar, commit c0e1e2b)", table());
}

}  // namespace croon::stages::preprocessor

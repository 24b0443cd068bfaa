#include "framework/stage/preprocessor.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::preprocessor {
namespace {

struct Params {
  double min = 1.0;
  double max = 1e9;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = [] {
    params::Table<Params> rows = {
        params::number("min", &Params::min, {-1e9, 1e9},
                       "Minimum intensity, in the units of the data."),
        params::number("max", &Params::max, {-1e9, 1e9},
                       "Maximum intensity; excludes traffic signs and number plates."),
    };
    rows.require([](const Params& params) { return params.min <= params.max; },
                 "min must not be above max");
    return rows;
  }();
  return table;
}

class IntensityThreshold final : public Preprocessor {
 public:
  explicit IntensityThreshold(const Params& params) : params_(params) {}

  static params::DataFlow data_flow(const Params&) { return params::needs_channels({kIntensity}); }

  PointCloud apply(const PointCloud& cloud) const override {
    const std::vector<double> intensity = channel_values(cloud, kIntensity);
    return filtered(cloud, [&](std::size_t i) {
      return intensity[i] >= params_.min && intensity[i] <= params_.max;
    });
  }

 private:
  Params params_;
};

}  // namespace

StageEntry intensity_threshold() {
  return stage_entry<IntensityThreshold>("intensity_threshold",
                                         "Keeps the points whose intensity is within bounds.",
                                         "croon", table());
}

}  // namespace croon::stages::preprocessor

#include <croon/stage/stage_entry.hpp>

#include "overlap_measure.hpp"

namespace croon::stages::overlap_measure {
namespace {

struct Params {
  double max_distance_m = 0.2;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::number("max_distance_m", &Params::max_distance_m, {0.001, 100.0},
                     "Points of the two clouds that are nearer to each other see one surface."),
  };
  return table;
}

class Nearest final : public OverlapMeasure {
 public:
  explicit Nearest(const Params& params) : params_(params) {}

  double overlap_ratio(const Cloud& target, const Cloud& source,
                       const RigidTransform& T_target_source) const override {
    if (target.empty() || source.empty()) return 0.0;
    std::size_t common = 0;
    for (const Eigen::Vector3f& point : transformed(source.points(), T_target_source)) {
      if (target.kd_tree().nearest(point, static_cast<float>(params_.max_distance_m))) ++common;
    }
    return static_cast<double>(common) / static_cast<double>(source.points().size());
  }

 private:
  Params params_;
};

}  // namespace

StageEntry nearest() {
  return stage_entry<Nearest>("nearest",
                              "The share of the sensor's points that have a neighbour in the "
                              "reference's cloud.",
                              "an example", table());
}

}  // namespace croon::stages::overlap_measure

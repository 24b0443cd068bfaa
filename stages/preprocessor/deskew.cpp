#include "framework/spatial/deskew.hpp"
#include "framework/base/angles.hpp"
#include "framework/params/choice.hpp"
#include "framework/stage/given_motions.hpp"
#include "framework/stage/preprocessor.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::preprocessor {
namespace {

enum class Reference { zero, first, middle };

struct Params {
  std::vector<double> linear_mps = {0.0, 0.0, 0.0};
  std::vector<double> angular_degps = {0.0, 0.0, 0.0};
  Reference reference_time = Reference::zero;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = [] {
    params::Table<Params> rows = {
        params::numbers("linear_mps", &Params::linear_mps, {-kMaxSpeed_mps, kMaxSpeed_mps},
                        "The sensor's velocity along x, y, z of its own frame."),
        params::numbers("angular_degps", &Params::angular_degps,
                        {-kMaxTurnRate_degps, kMaxTurnRate_degps},
                        "Its angular velocity about x, y, z of its own frame."),
        params::choice(
            "reference_time", &Params::reference_time,
            {{"zero", Reference::zero}, {"first", Reference::first}, {"middle", Reference::middle}},
            "Time to which the points are moved: zero of the channel time, the time of the first "
            "point, or half-way between the first and the last."),
    };
    rows.require(
        [](const Params& p) { return p.linear_mps.size() == 3 && p.angular_degps.size() == 3; },
        "linear_mps and angular_degps must have three numbers each");
    return rows;
  }();
  return table;
}

/// Moves each point to where a sensor at rest in its pose at the reference time would have measured
/// it: `p -> T(t_reference, t) p`, for a constant velocity.
class Deskew final : public Preprocessor {
 public:
  explicit Deskew(const Params& params) : reference_(params.reference_time) {
    for (int axis = 0; axis < 3; ++axis) {
      velocity_.linear_mps(axis) = params.linear_mps[axis];
      velocity_.angular_radps(axis) = rad_from_deg(params.angular_degps[axis]);
    }
  }

  static params::DataFlow data_flow(const Params&) { return params::needs_channels({kTime}); }

  PointCloud apply(const PointCloud& cloud) const override {
    if (cloud.empty()) return cloud;
    const std::vector<double> times = times_s(cloud);
    return deskewed(cloud, times, velocity_, reference_time_s(times));
  }

 private:
  double reference_time_s(const std::vector<double>& times) const {
    const TimeSpan span = span_of(times);
    const double reference_s = reference_ == Reference::zero    ? 0.0
                               : reference_ == Reference::first ? span.first_s
                                                                : span.middle_s();
    require_near(times, reference_s);
    return reference_s;
  }

  Twist velocity_;
  Reference reference_;
};

}  // namespace

StageEntry deskew() {
  return stage_entry<Deskew>(
      "deskew", "Removes the distortion of a scan from a constant velocity of the sensor.",
      "Zhang and Singh, LOAM, 2014, section V.B", table());
}

}  // namespace croon::stages::preprocessor

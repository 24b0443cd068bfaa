#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/registration/pose_uncertainty.hpp"
#include "framework/stage/motion.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"

namespace croon::stages::step {
namespace {

struct Params : UncertaintyOptions {
  std::vector<double> velocity_std_mps = {0.0, 0.0, 0.0};
  double yaw_rate_std_degps = 0.0;
};

/// The rows of UncertaintyOptions.
const params::Table<UncertaintyOptions>& option_table() {
  using O = UncertaintyOptions;
  static const params::Table<O> table = {
      params::number("max_distance_m", &O::max_distance_m, {0.0, 1e6},
                     "Maximum distance between points of the two clouds that count as in contact."),
      params::integer("normal_neighbours", &O::normal_neighbours, {3, 1000},
                      "Number of neighbours from which a normal is computed."),
      params::number("direction_balance", &O::direction_balance, {0.0, 1.0},
                     "As in the registration that computed the pose: each of n contacts with "
                     "similar normals is weighted by n^-k, k being this."),
      params::number("kernel_width_m", &O::kernel_width_m, {1e-6, 1e6},
                     "As in that registration: larger residuals lose weight."),
      params::number("surface_size_m", &O::surface_size_m, {0.01, 1e6},
                     "Contacts with similar normals in a cell of this edge form one surface, whose "
                     "errors are dependent."),
      params::boolean("follows_contacts", &O::follows_contacts,
                      "Whether the Hessian accounts for contacts that change with the pose."),
      params::number("std_scale", &O::std_scale, {0.0, 1e6},
                     "Factor on the standard deviations from differences between surfaces, not on "
                     "those from grazing incidence and motion; tuned on scenes with ground truth.")
          .formerly("scale"),
      params::number("grazing_error_ratio", &O::grazing_error_ratio, {0.0, 1e3},
                     "Common error of surfaces seen at more than 60 degrees from their normals, as "
                     "a multiple of the noise."),
      params::number("line_breadth_ratio", &O::line_breadth_ratio, {0.0, 1.0},
                     "Neighbours lie on a line if their spread across their main axis is below the "
                     "noise and below this multiple of the spread along it. Their normals are "
                     "ignored when classifying observability."),
      params::number("weak_ratio", &O::weak_ratio, {0.0, 1e9},
                     "A degree of freedom is weak if its information is below this multiple of the "
                     "information that normal noise alone would produce."),
      params::number("unobservable_ratio", &O::unobservable_ratio, {0.0, 1e9},
                     "Ratio below which it is unobservable."),
  };
  return table;
}

const params::Table<Params>& table() {
  static const params::Table<Params> table = [] {
    params::Table<Params> rows =
        params::Table<Params>{
            params::numbers(
                "velocity_std_mps", &Params::velocity_std_mps, {0.0, 1000.0},
                "Standard deviation of the car's velocity during the scans, along x, y, z of the "
                "reference, in addition to the covariance of a velocity that a step estimated. If "
                "not zero, the clouds need the channel time."),
            params::number("yaw_rate_std_degps", &Params::yaw_rate_std_degps, {0.0, 3600.0},
                           "Standard deviation of its yaw rate.")
                .formerly("turning_std_degps"),
        }
            .inherit(option_table());
    rows.require([](const Params& p) { return p.unobservable_ratio <= p.weak_ratio; },
                 "unobservable_ratio must not be above weak_ratio");
    rows.require([](const Params& p) { return p.velocity_std_mps.size() == 3; },
                 "velocity_std_mps must have three numbers");
    return rows;
  }();
  return table;
}

class CovarianceStep final : public Step {
 public:
  explicit CovarianceStep(const Params& chosen) : options_(options_of(chosen)) {}

  static params::DataFlow data_flow(const Params& chosen) {
    params::DataFlow flow = gives(kCovariance);
    if (!options_of(chosen).motion_covariance.isZero(0.0)) {
      flow.add(params::needs_channels({kTime}));
    }
    return flow;
  }

  Estimate advance(Estimate estimate, Rng&) const override {
    UncertaintyOptions options = options_;
    if (const Matrix6d* const motion = estimate.extras.find(kMotionCovariance)) {
      options.motion_covariance += *motion;
    }
    estimate.covariance =
        pose_uncertainty(*estimate.target, *estimate.source, estimate.T_target_source, options);
    estimate.diagnostics.clear();
    for (int i = 0; i < 6; ++i) {
      const double std = std::sqrt(estimate.covariance->matrix(i, i));
      const std::string& name = kDofNames.at(static_cast<std::size_t>(i));
      estimate.diagnostics.emplace_back(name + (i < 3 ? "_std_deg" : "_std_m"),
                                        i < 3 ? deg_from_rad(std) : std);
    }
    return estimate;
  }

 private:
  static UncertaintyOptions options_of(const Params& chosen) {
    UncertaintyOptions options = chosen;
    Vector6d stds;
    stds << 0.0, 0.0, rad_from_deg(chosen.yaw_rate_std_degps),
        Eigen::Vector3d(chosen.velocity_std_mps.data());
    options.motion_covariance = stds.cwiseAbs2().asDiagonal();
    return options;
  }

  UncertaintyOptions options_;
};

}  // namespace

StageEntry covariance() {
  return stage_entry<CovarianceStep>(
      "covariance",
      "Estimates the covariance of the pose, and classifies each degree of freedom as determined, "
      "weak or unobservable.",
      "croon; jackknife over clusters after Bell and McCaffrey, Survey Methodology 2002", table(),
      6);
}

}  // namespace croon::stages::step

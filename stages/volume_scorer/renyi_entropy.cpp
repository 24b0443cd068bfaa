#include <cmath>

#include "framework/params/values.hpp"
#include "framework/spatial/evenly_spaced.hpp"
#include "framework/spatial/points_by_cube.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/volume_scorer.hpp"

namespace croon::stages::volume_scorer {
namespace {

struct Params {
  double width_m = 0.05;
  int max_points = 1500;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::number("width_m", &Params::width_m, {1e-3, 100.0},
                     "Standard deviation of the Gaussian that blurs each point."),
      params::integer("max_points", &Params::max_points, {1, 1e9},
                      "Maximum number of the sensor's points that are used, evenly spaced."),
  };
  return table;
}

/// Points farther apart than this many widths are not paired: their Gaussians overlap by 1e-4 of
/// the overlap of coincident points.
constexpr double kReach = 6.0;

/// The exponential of the quadratic Renyi entropy of the density p of all blurred points,
///
///   exp(H2) = 1 / int p^2 = N^2 / sum_ij G(x_i - x_j),   G(d) = exp(-d^2 / 4 w^2) / (4 pi
///   w^2)^1.5,
///
/// which is the volume of a uniform density of the same entropy. Pairs within one cloud do not
/// depend on the pose; of these only each point with itself is counted.
class RenyiEntropy final : public VolumeScorer {
 public:
  explicit RenyiEntropy(const Params& params) : params_(params) {}

  VolumeFunction bind(std::shared_ptr<const Cloud> target,
                      std::shared_ptr<const Cloud> source) const override {
    const auto bound = target->once<PointsByCube>(
        "volume_scorer/renyi_entropy", params::value_json(params_.width_m),
        [&] { return std::make_shared<PointsByCube>(target->points(), kReach * params_.width_m); });
    const Points points = evenly_spaced(source->points(), params_.max_points);
    const double of_one_m3 = std::pow(4.0 * M_PI * params_.width_m * params_.width_m, 1.5);
    const double by_m2 = 1.0 / (4.0 * params_.width_m * params_.width_m);
    return {[bound, points, of_one_m3, by_m2](const RigidTransform& T_target_source) {
              const auto n = static_cast<double>(bound->size() + points.size());
              if (n == 0.0) return OccupiedVolume{};
              double sum = n;
              for (const Eigen::Vector3f& point : points) {
                double overlaps = 0.0;
                bound->for_each_near(
                    T_target_source * point.cast<double>(),
                    [&](const Eigen::Vector3d&, double m2) { overlaps += std::exp(-m2 * by_m2); });
                sum += 2.0 * overlaps;
              }
              return OccupiedVolume{n * n / sum * of_one_m3, 0};
            },
            Poses::in_parallel};
  }

 private:
  Params params_;
};

}  // namespace

StageEntry renyi_entropy() {
  return stage_entry<RenyiEntropy>(
      "renyi_entropy",
      "The exponential of the quadratic Renyi entropy of both clouds, each point blurred by a "
      "Gaussian, without the pairs within a cloud: a volume that is smooth in the pose.",
      "Sheehan, Harrison and Newman, Self-calibration for a 3D laser, 2012", table());
}

}  // namespace croon::stages::volume_scorer

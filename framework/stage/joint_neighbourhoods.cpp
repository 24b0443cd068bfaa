#include "framework/stage/joint_neighbourhoods.hpp"

#include <cmath>
#include <vector>

#include "framework/params/values.hpp"
#include "framework/spatial/evenly_spaced.hpp"
#include "framework/spatial/points_by_cube.hpp"

namespace croon {
namespace {

/// The weighted sums over points around a position: of ones, of offsets and of their products.
struct Moments {
  double weight = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& offset, double squared_m2, double radius_m) {
    const double share = 1.0 - squared_m2 / (radius_m * radius_m);
    const double w = share * share;
    weight += w;
    first += w * offset;
    second += w * (offset * offset.transpose());
  }
};

Moments moments_around(const PointsByCube& points, const Eigen::Vector3d& place) {
  Moments moments;
  points.for_each_near(place, [&](const Eigen::Vector3d& point, double squared_m2) {
    moments.add(point - place, squared_m2, points.reach_m());
  });
  return moments;
}

/// A position in the source and the source's own points around it, in the source's frame.
struct Sample {
  Eigen::Vector3d place;
  Moments own;
};

/// The covariance of the points of both clouds around a sample.
Eigen::Matrix3d covariance_of(const Sample& sample, const PointsByCube& target,
                              const RigidTransform& T_target_source) {
  const Eigen::Matrix3d& R = T_target_source.rotation;
  const Moments other = moments_around(target, T_target_source * sample.place);
  const double weight = sample.own.weight + other.weight;
  const Eigen::Vector3d mean = (R * sample.own.first + other.first) / weight;
  const Eigen::Matrix3d second = (R * sample.own.second * R.transpose() + other.second) / weight;
  return second - mean * mean.transpose();
}

std::shared_ptr<const PointsByCube> bound(const Cloud& cloud, double radius_m) {
  return cloud.once<PointsByCube>("joint_neighbourhoods", params::value_json(radius_m), [&] {
    return std::make_shared<PointsByCube>(cloud.points(), radius_m);
  });
}

}  // namespace

const params::Table<NeighbourhoodOptions>& neighbourhood_table() {
  static const params::Table<NeighbourhoodOptions> table = {
      params::number("radius_m", &NeighbourhoodOptions::radius_m, {1e-3, 100.0},
                     "Maximum distance between neighbours."),
      params::number("noise_m", &NeighbourhoodOptions::noise_m, {1e-6, 100.0},
                     "Standard deviation added to every neighbourhood, a minimum thickness."),
      params::integer("max_points", &NeighbourhoodOptions::max_points, {1, 1e9},
                      "Maximum number of neighbourhoods, around evenly spaced points of the "
                      "sensor."),
  };
  return table;
}

VolumeFunction volume_of_neighbourhoods(const std::shared_ptr<const Cloud>& target,
                                        const std::shared_ptr<const Cloud>& source,
                                        const NeighbourhoodOptions& options,
                                        NeighbourhoodMeasure measure, NeighbourhoodMean mean) {
  const auto of_target = bound(*target, options.radius_m);
  const auto of_source = bound(*source, options.radius_m);
  std::vector<Sample> samples;
  for (const Eigen::Vector3f& point : evenly_spaced(source->points(), options.max_points)) {
    const Eigen::Vector3d place = point.cast<double>();
    samples.push_back({place, moments_around(*of_source, place)});
  }
  return {[of_target, samples, options, measure, mean](const RigidTransform& T_target_source) {
            if (samples.empty()) return OccupiedVolume{};
            const Eigen::Matrix3d noise =
                options.noise_m * options.noise_m * Eigen::Matrix3d::Identity();
            const bool is_geometric = mean == NeighbourhoodMean::geometric;
            double sum = 0.0;
            for (const Sample& sample : samples) {
              const double volume_m3 =
                  measure(covariance_of(sample, *of_target, T_target_source) + noise, options);
              sum += is_geometric ? std::log(volume_m3) : volume_m3;
            }
            const double of_all = sum / static_cast<double>(samples.size());
            return OccupiedVolume{is_geometric ? std::exp(of_all) : of_all, 0};
          },
          Poses::in_parallel};
}

}  // namespace croon

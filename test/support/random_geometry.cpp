#include "test/support/random_geometry.hpp"

#include "framework/base/angles.hpp"

namespace croon::test {
namespace {

/// A rectangle `origin + u a + v b`, u and v in [0, 1].
struct Patch {
  Eigen::Vector3d origin, a, b;
  double area() const { return a.cross(b).norm(); }
};

void add_box(std::vector<Patch>& patches, const Eigen::Vector3d& low, const Eigen::Vector3d& size) {
  const Eigen::Vector3d x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  patches.push_back({low, x, z});
  patches.push_back({low + y, x, z});
  patches.push_back({low, y, z});
  patches.push_back({low + x, y, z});
  patches.push_back({low + z, x, y});
}

std::vector<Patch> street(std::uint64_t scene_seed) {
  Rng rng(StreamKey(scene_seed).with("street"));
  constexpr double kGround = -2.0;
  std::vector<Patch> patches;
  patches.push_back({{-20, -9, kGround}, {40, 0, 0}, {0, 18, 0}});
  for (const double side : {-9.0, 9.0}) {
    for (double x = -20.0; x < 20.0; x += 5.0) {
      const double depth = rng.uniform(0.0, 2.0);
      add_box(patches, {x, side - (side > 0 ? depth : 0.0), kGround},
              {rng.uniform(2.0, 5.0), depth, rng.uniform(3.0, 6.0)});
    }
  }
  for (int i = 0; i < 6; ++i) {
    add_box(patches, {rng.uniform(-15, 12), rng.uniform(-6, 5), kGround}, {3.5, 1.6, 1.5});
  }
  for (int i = 0; i < 8; ++i) {
    add_box(patches, {rng.uniform(-18, 18), rng.uniform(-7, 7), kGround}, {0.3, 0.3, 4.0});
  }
  return patches;
}

}  // namespace

Rng test_rng(std::uint64_t seed) { return Rng(StreamKey(seed).with("test")); }

RigidTransform random_pose(Rng& rng, double extent_m) {
  Eigen::Vector4d q{rng.normal(), rng.normal(), rng.normal(), rng.normal()};
  q.normalize();
  RigidTransform T;
  T.rotation = Eigen::Quaterniond(q(0), q(1), q(2), q(3)).toRotationMatrix();
  for (int i = 0; i < 3; ++i) T.translation(i) = rng.uniform(-extent_m, extent_m);
  return T;
}

RigidTransform pose_near(Rng& rng, const RigidTransform& pose, double rotation_deg,
                         double translation_m) {
  Vector6d offset;
  const double rotation_rad = rad_from_deg(rotation_deg);
  for (int i = 0; i < 3; ++i) offset(i) = rng.uniform(-rotation_rad, rotation_rad);
  for (int i = 3; i < 6; ++i) offset(i) = rng.uniform(-translation_m, translation_m);
  return moved(pose, offset);
}

Vector6d pose_vector(Rng& rng) {
  Vector6d vector;
  for (int i = 0; i < 6; ++i) vector(i) = (i < 3 ? 0.01 : 0.1) * rng.normal();
  return vector;
}

PoseCovariance random_covariance(Rng& rng) {
  PoseCovariance covariance;
  for (int i = 0; i < 8; ++i) {
    const Vector6d direction = pose_vector(rng);
    covariance.matrix += direction * direction.transpose();
  }
  for (Observability& word : covariance.dofs) {
    word = kObservabilities.at(rng.below(kObservabilities.size()));
  }
  return covariance;
}

Eigen::Vector3d random_point(Rng& rng, double extent_m) {
  return random_cloud(rng, 1, extent_m).front().cast<double>();
}

Points random_cloud(Rng& rng, int count, double extent_m) {
  Points cloud;
  for (int i = 0; i < count; ++i) {
    const double x = rng.uniform(-extent_m, extent_m);
    const double y = rng.uniform(-extent_m, extent_m);
    const double z = rng.uniform(-extent_m, extent_m);
    cloud.push_back(Eigen::Vector3d(x, y, z).cast<float>());
  }
  return cloud;
}

Points random_street(Rng& rng, std::uint64_t scene_seed, int count, double noise_m) {
  const std::vector<Patch> patches = street(scene_seed);
  double total = 0.0;
  for (const Patch& patch : patches) total += patch.area();
  Points cloud;
  for (int i = 0; i < count; ++i) {
    double place = rng.uniform(0.0, total);
    std::size_t chosen = 0;
    while (chosen + 1 < patches.size() && place > patches[chosen].area()) {
      place -= patches[chosen++].area();
    }
    const Patch& patch = patches[chosen];
    const double u = rng.uniform(), v = rng.uniform();
    const Eigen::Vector3d noise{rng.normal(), rng.normal(), rng.normal()};
    cloud.push_back((patch.origin + u * patch.a + v * patch.b + noise_m * noise).cast<float>());
  }
  return cloud;
}

StreetPair street_pair(Rng& rng, std::uint64_t scene_seed, const RigidTransform& T_target_source,
                       int target_count, int source_count, double noise_m,
                       const RigidTransform& T_target_street) {
  StreetPair pair;
  pair.T_target_source = T_target_source;
  pair.target = transformed(random_street(rng, scene_seed, target_count, noise_m), T_target_street);
  pair.source = transformed(random_street(rng, scene_seed, source_count, noise_m),
                            T_target_source.inverse() * T_target_street);
  return pair;
}

PointCloud measured(const Points& points) {
  constexpr std::size_t kRings = 16;
  PointCloud cloud = points;
  std::vector<float> intensity;
  std::vector<std::uint16_t> ring;
  std::vector<double> time_s;
  for (std::size_t i = 0; i < points.size(); ++i) {
    intensity.push_back(static_cast<float>(1 + i * 7 % 100));
    ring.push_back(static_cast<std::uint16_t>(i % kRings));
    time_s.push_back(1e-5 * static_cast<double>(i / kRings));
  }
  cloud.channels = {make_channel(kIntensity, intensity), make_channel(kRing, ring),
                    make_channel(kTime, time_s)};
  return cloud;
}

}  // namespace croon::test

#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/error.hpp"
#include "test/stages/volume_scorer/scorers.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

LeafOptions random_options(Rng& rng) {
  LeafOptions options;
  options.leaf_size_m = rng.uniform(0.05, 0.4);
  options.leaf_sizes = 1 + static_cast<int>(rng.below(3));
  options.lattices = 1 + static_cast<int>(rng.below(5));
  options.min_points = 1 + static_cast<int>(rng.below(4));
  for (double& share : options.lattice_offset_ratio.values) share = rng.uniform(0.0, 1.0);
  return options;
}

TEST(LeafOptions, AllScorersCountWhatTheySay) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 40; ++i) {
    const double extent_m = i % 2 == 0 ? 1.0 : 10.0;
    const Points target = test::random_cloud(rng, 800, extent_m);
    const Points source = test::random_cloud(rng, 600, extent_m);
    const RigidTransform pose = test::random_pose(rng, extent_m);
    test::expect_equal_counts(target, source, {RigidTransform{}, pose}, random_options(rng));
  }
}

TEST(LeafOptions, AllScorersCountWhatTheySayFarFromTheOrigin) {
  Rng rng = test::test_rng();
  const RigidTransform far{Eigen::Matrix3d::Identity(), Eigen::Vector3d(4e5, -5e6, 300)};
  for (int i = 0; i < 5; ++i) {
    const Points target = transformed(test::random_cloud(rng, 400, 5.0), far);
    const Points source = test::random_cloud(rng, 400, 5.0);
    const RigidTransform pose = far * test::random_pose(rng, 1.0);
    test::expect_equal_counts(target, source, {RigidTransform{}, pose}, random_options(rng));
  }
}

TEST(LeafOptions, FewPointsAndNone) {
  Rng rng = test::test_rng();
  const Points same(3, Eigen::Vector3f(-0.3F, 0.7F, 2.0F));
  for (const Points& target : {Points{}, same}) {
    for (const Points& source : {Points{}, same, test::random_cloud(rng, 50, 1.0)}) {
      for (int i = 0; i < 4; ++i) {
        const RigidTransform pose = test::random_pose(rng, 1.0);
        test::expect_equal_counts(target, source, {pose}, random_options(rng));
      }
    }
  }
}

TEST(LeafOptions, PointsOutsideOfTheGridAreRefusedWithAnyOptions) {
  Rng rng = test::test_rng();
  const Points near = {{0.0F, 0.0F, 0.0F}};
  const Points far = {{0.0F, 1e12F, 0.0F}};
  for (int i = 0; i < 5; ++i) {
    for (const auto& [name, scorer] : test::all_scorers(random_options(rng))) {
      SCOPED_TRACE(name);
      EXPECT_THROW(scorer->bind(test::cloud_of(far), test::cloud_of(near)), StageError);
      const VolumeFunction volume = scorer->bind(test::cloud_of(near), test::cloud_of(far));
      EXPECT_THROW(volume({}), StageError);
    }
  }
}

/// The spread (standard deviation over mean) of the volume of a wall and a floor that both clouds
/// see, as both move through the lattice together.
double spread_of_volume(Rng& rng, const LeafOptions& options) {
  Points cloud;
  for (int i = 0; i < 4000; ++i) {
    const double u = rng.uniform(0.0, 2.0);
    const double v = rng.uniform(0.0, 2.0);
    const double noise = 0.01 * rng.normal();
    const Eigen::Vector3d point = i % 2 == 0 ? Eigen::Vector3d(u, noise, v)  //
                                             : Eigen::Vector3d(u, v, noise);
    cloud.push_back(point.cast<float>());
  }
  const auto [name, scorer] = test::all_scorers(options).at(0);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kShifts = 40;
  for (int i = 0; i < kShifts; ++i) {
    const Eigen::Vector3d shift{0.0, rng.uniform(0.0, 0.1), rng.uniform(0.0, 0.1)};
    const auto target = test::cloud_of(transformed(cloud, {Eigen::Matrix3d::Identity(), shift}));
    const double volume = scorer->bind(target, test::cloud_of({}))({}).m3;
    sum += volume;
    squares += volume * volume;
  }
  const double mean = sum / kShifts;
  return std::sqrt(squares / kShifts - mean * mean) / mean;
}

TEST(LeafOptions, SeveralLatticesForgetWhereSurfacesLieBetweenTheBordersOfLeaves) {
  Rng rng = test::test_rng();
  LeafOptions options = test::leaves_of(0.1);
  const double one = spread_of_volume(rng, options);
  options.lattices = 8;
  EXPECT_LT(spread_of_volume(rng, options), one / 3);
}

TEST(LeafOptions, MorePointsPerLeafOccupyLess) {
  Rng rng = test::test_rng();
  const auto target = test::cloud_of(test::random_cloud(rng, 3000, 1.0));
  const auto source = test::cloud_of(test::random_cloud(rng, 3000, 1.0));
  const RigidTransform pose = test::random_pose(rng, 0.3);
  LeafOptions options = test::leaves_of(0.2);
  const auto leaves = [&] {
    return test::all_scorers(options).at(0).second->bind(target, source)(pose).leaves;
  };
  std::int64_t last = leaves();
  for (options.min_points = 2; options.min_points < 6; ++options.min_points) {
    const std::int64_t fewer = leaves();
    EXPECT_LT(fewer, last);
    last = fewer;
  }
}

TEST(LeafOptions, LatticesThatVariantsShareAreMadeOnce) {
  Rng rng = test::test_rng();
  const auto target = test::cloud_of(test::random_cloud(rng, 300, 1.0));
  LeafOptions options = test::leaves_of(0.1);
  options.lattices = 4;
  const auto bind = [&] {
    test::all_scorers(options).at(0).second->bind(target, test::cloud_of({}));
    return target->timings().size();
  };
  const std::size_t four = bind();
  options.lattices = 1;
  EXPECT_EQ(bind(), four);
  options.lattices = 5;
  EXPECT_EQ(bind(), four + 1);
}

}  // namespace
}  // namespace croon

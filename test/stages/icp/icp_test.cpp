#include "framework/stage/icp.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/geometry/dof.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

/// How near the truth a variant ends on two noisy samplings of one street. Point-to-point is worse
/// by design: it pulls points to other points of the same surface.
struct Expectation {
  std::string json;
  double rotation_deg;
  double translation_m;
};

const std::vector<Expectation> kVariants = {
    {R"({"type": "point_to_point"})", 0.5, 0.15}, {R"({"type": "point_to_plane"})", 0.1, 0.02},
    {R"({"type": "icpn"})", 0.1, 0.02},           {R"({"type": "nicp"})", 0.1, 0.02},
    {R"({"type": "gicp"})", 0.1, 0.02},           {R"({"type": "trimmed"})", 0.1, 0.02},
};

test::StreetPair street_pair(std::uint64_t seed, double noise_m) {
  Rng rng = test::test_rng(seed);
  const RigidTransform truth = test::pose_near(rng, {}, 180.0, 1.0);
  return test::street_pair(rng, seed, truth, 20000, 8000, noise_m);
}

TEST(Icp, EveryVariantReturnsToTheTruth) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const test::StreetPair pair = street_pair(seed, 0.01);
    const Cloud target(pair.target, StreamKey(1));
    const Cloud source(pair.source, StreamKey(2));
    for (const Expectation& variant : kVariants) {
      const params::Slot<Icp> icp = test::stage<Icp>(variant.json);
      Rng rng = test::test_rng(seed);
      const RigidTransform start = test::pose_near(rng, pair.T_target_source, 2.0, 0.2);
      const Registration result = icp->align(target, source, start);
      const PoseError error = pose_error(result.T_target_source, pair.T_target_source);
      EXPECT_LT(deg_from_rad(error.rotation_rad), variant.rotation_deg) << variant.json << seed;
      EXPECT_LT(error.translation_m, variant.translation_m) << variant.json << seed;
      EXPECT_GT(result.inlier_ratio, 0.5) << variant.json;
    }
  }
}

TEST(Icp, EveryKernelReturnsToTheTruthAmongStrayPoints) {
  test::StreetPair pair = street_pair(4, 0.01);
  Rng rng = test::test_rng(9);
  const Points stray = test::random_cloud(rng, 1500, 8.0);
  pair.source.insert(pair.source.end(), stray.begin(), stray.end());
  const Cloud target(pair.target, StreamKey(1));
  const Cloud source(pair.source, StreamKey(2));
  const RigidTransform start = test::pose_near(rng, pair.T_target_source, 2.0, 0.2);
  for (const char* kernel : {"none", "huber", "cauchy", "geman_mcclure"}) {
    const auto icp =
        test::stage<Icp>(std::string(R"({"type": "icpn", "kernel": ")") + kernel + "\"}");
    const PoseError error =
        pose_error(icp->align(target, source, start).T_target_source, pair.T_target_source);
    EXPECT_LT(deg_from_rad(error.rotation_rad), 0.2) << kernel;
    EXPECT_LT(error.translation_m, 0.04) << kernel;
  }
}

TEST(Icp, TrimmedForgetsTheShareThatIsFarOff) {
  // A quarter of the source is a second street, 40 cm to the side.
  test::StreetPair pair = street_pair(4, 0.005);
  const std::size_t shifted = pair.source.size() / 4;
  for (std::size_t i = 0; i < shifted; ++i) pair.source[4 * i] += Eigen::Vector3f(0.4F, 0.4F, 0.4F);
  const Cloud target(pair.target, StreamKey(1));
  const Cloud source(pair.source, StreamKey(2));
  const auto error_of = [&](const char* keep_ratio) {
    const auto icp = test::stage<Icp>(
        std::string(R"({"type": "trimmed", "max_distances_m": [2], "keep_ratio": )") + keep_ratio +
        "}");
    const Registration result = icp->align(target, source, pair.T_target_source);
    EXPECT_NEAR(result.inlier_ratio, std::stod(keep_ratio), 0.05);
    return pose_error(result.T_target_source, pair.T_target_source).translation_m;
  };
  const double trimmed = error_of("0.7"), all = error_of("1");
  EXPECT_GT(all, 0.02);
  EXPECT_LT(trimmed, 0.7 * all);
}

TEST(Icp, IsEquivariantUnderMotionsOfTheTarget) {
  const test::StreetPair pair = street_pair(5, 0.01);
  Rng rng = test::test_rng(5);
  // A turn about the sensor keeps its origin, towards which normals are turned.
  RigidTransform T_moved_target = test::random_pose(rng, 0.0);
  const Cloud source(pair.source, StreamKey(2));
  const Cloud target(pair.target, StreamKey(1));
  const Cloud moved_target(transformed(pair.target, T_moved_target), StreamKey(1));
  const RigidTransform start = test::pose_near(rng, pair.T_target_source, 1.0, 0.1);
  for (const Expectation& variant : kVariants) {
    const auto icp = test::stage<Icp>(variant.json);
    const RigidTransform T = icp->align(target, source, start).T_target_source;
    const RigidTransform T_moved =
        icp->align(moved_target, source, T_moved_target * start).T_target_source;
    const PoseError error = pose_error(T_moved, T_moved_target * T);
    // Rounding of the moved points to float moves a few correspondences.
    EXPECT_LT(deg_from_rad(error.rotation_rad), 0.01) << variant.json;
    EXPECT_LT(error.translation_m, 0.003) << variant.json;
  }
}

TEST(Icp, InformationIsSymmetricAndKnowsTheOpenDirections) {
  // A corridor along x, without ends: x is open, the rest is not.
  Rng rng = test::test_rng();
  Points corridor;
  for (int i = 0; i < 12000; ++i) {
    const double x = rng.uniform(-20, 20);
    const double v = rng.uniform(-2, 2);
    corridor.push_back(i % 3 == 0   ? Eigen::Vector3f(x, v, -2)
                       : i % 3 == 1 ? Eigen::Vector3f(x, -3, v)
                                    : Eigen::Vector3f(x, 3, v));
  }
  const Cloud target(corridor, StreamKey(1));
  const Cloud source(corridor, StreamKey(2));
  for (const char* name : {"point_to_plane", "icpn"}) {
    const auto icp = test::stage<Icp>(std::string("{\"type\": \"") + name + "\"}");
    const Matrix6d H = icp->align(target, source, {}).information;
    EXPECT_EQ(H, H.transpose()) << name;
    const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(H);
    EXPECT_GE(solver.eigenvalues()(0), -1e-6 * solver.eigenvalues()(5)) << name;
    EXPECT_LT(H(3, 3), 1e-2 * H(4, 4)) << name;
    EXPECT_GT(std::abs(solver.eigenvectors()(3, 0)), 0.99) << name;
  }
}

TEST(Icp, FailsWithAReasonWhereNothingCorresponds) {
  Rng rng = test::test_rng();
  const Cloud target(test::random_cloud(rng, 500, 1.0), StreamKey(1));
  const Cloud source(test::random_cloud(rng, 500, 1.0), StreamKey(2));
  RigidTransform far_away;
  far_away.translation = {100.0, 0.0, 0.0};
  for (const Expectation& variant : kVariants) {
    EXPECT_THROW(test::stage<Icp>(variant.json)->align(target, source, far_away), StageError);
  }
}

}  // namespace
}  // namespace croon

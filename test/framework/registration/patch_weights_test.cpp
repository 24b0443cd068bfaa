#include <gtest/gtest.h>

#include <numeric>

#include "framework/registration/direction_balance.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

/// Points of two squares of 1 m that are 10 m apart, a hundred on the first and ten on the second.
std::shared_ptr<const Cloud> two_patches() {
  Rng rng = test::test_rng();
  Points points;
  for (int i = 0; i < 110; ++i) {
    const double x = i < 100 ? 0.1 : 10.1;
    points.push_back(
        Eigen::Vector3d{x + 0.8 * rng.uniform(), 0.1 + 0.8 * rng.uniform(), 0.5}.cast<float>());
  }
  return std::make_shared<const Cloud>(PointCloud(std::move(points)), StreamKey(1));
}

std::vector<double> weights(double exponent) {
  std::vector<int> indices(110);
  std::iota(indices.begin(), indices.end(), 0);
  return patch_weights(patches_of(*two_patches(), indices, 5, 2.0), exponent);
}

TEST(PatchWeights, AreOneWithoutBalance) {
  for (const double weight : weights(0.0)) EXPECT_EQ(weight, 1.0);
}

TEST(PatchWeights, MakePatchesEqualWithFullBalance) {
  const std::vector<double> balanced = weights(1.0);
  EXPECT_NEAR(std::accumulate(balanced.begin(), balanced.begin() + 100, 0.0), 1.0, 1e-12);
  EXPECT_NEAR(std::accumulate(balanced.begin() + 100, balanced.end(), 0.0), 1.0, 1e-12);
}

}  // namespace
}  // namespace croon

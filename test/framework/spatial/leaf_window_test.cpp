#include "framework/spatial/leaf_window.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "framework/base/error.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

using Instructions = LeafWindow::Instructions;

RigidTransform shifted(const Eigen::Vector3d& translation) {
  return {Eigen::Matrix3d::Identity(), translation};
}

/// The keys by the grid's own function, point by point.
std::vector<std::uint64_t> keys_by_grid(const LeafWindow& window, const Points& points,
                                        const RigidTransform& T) {
  std::vector<std::uint64_t> keys;
  for (const Eigen::Vector3f& point : points) {
    keys.push_back(window.key_of(window.grid().leaf_of(T * point.cast<double>())).value());
  }
  return keys;
}

void expect_equal_keys(const LeafWindow& window, const Points& points, const RigidTransform& T) {
  const std::vector<std::uint64_t> expected = keys_by_grid(window, points, T);
  const PointColumns columns(points);
  std::vector<Instructions> codes = {Instructions::any_processor};
  if (LeafWindow::best_instructions() == Instructions::avx2) codes.push_back(Instructions::avx2);
  for (const Instructions code : codes) {
    std::vector<std::uint64_t> keys(points.size());
    window.compute_keys(columns, T, 0, points.size(), code, keys.data());
    EXPECT_EQ(keys, expected);
  }
  std::vector<std::uint64_t> visited;
  const FarLeaves far =
      window.for_each_block(columns, T, [&](const std::uint64_t* keys, std::size_t count) {
        visited.insert(visited.end(), keys, keys + count);
      });
  EXPECT_TRUE(far.empty());
  EXPECT_EQ(visited, expected);
}

TEST(LeafWindow, KeysAreThoseOfTheGridWithTheInstructionsOfAnyProcessor) {
  Rng rng = test::test_rng();
  for (const double leaf_size_m : {0.001, 0.02, 0.05, 0.1, 0.3, 7.0}) {
    for (const double extent_m : {0.3, 30.0, 300.0}) {
      for (const Eigen::Vector3d& offset :
           {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(-4e5, 5e5, 100),
            Eigen::Vector3d(0.5, -3, 1)}) {
        const LeafWindow window(LeafGrid(leaf_size_m), offset);
        const Points points = test::random_cloud(rng, 700, extent_m);
        expect_equal_keys(window, points, shifted(offset) * test::random_pose(rng, extent_m));
      }
    }
  }
}

TEST(LeafWindow, KeysAreThoseOfTheGridOnBordersOfLeavesAndBesideThem) {
  Rng rng = test::test_rng();
  for (const double leaf_size_m : {0.02, 0.05, 0.1, 0.25}) {
    const LeafWindow window(LeafGrid(leaf_size_m), {0, 0, 0});
    Points points;
    for (int i = 0; i < 3000; ++i) {
      Eigen::Vector3f point;
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const double border = leaf_size_m * (static_cast<double>(rng.below(2001)) - 1000);
        const float aside = static_cast<float>(rng.below(3)) - 1.0F;
        point(axis) = std::nextafter(static_cast<float>(border), aside * 1e9F);
      }
      points.push_back(point);
    }
    expect_equal_keys(window, points, RigidTransform{});
    expect_equal_keys(window, points, shifted({leaf_size_m, -leaf_size_m / 2, 3 * leaf_size_m}));
    // A sum of three products is rounded: its order shows at the borders.
    Points back;
    const RigidTransform T = test::random_pose(rng, 1.0);
    for (const Eigen::Vector3f& point : points) {
      back.push_back((T.inverse() * point.cast<double>()).cast<float>());
    }
    expect_equal_keys(window, back, T);
  }
}

TEST(LeafWindow, AKeyHoldsTheNumbersOfItsLeaf) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 1000; ++i) {
    const std::uint64_t x = rng.below(1 << 21);
    const std::uint64_t y = rng.below(1 << 21);
    const std::uint64_t z = rng.below(1 << 21);
    const std::array<std::uint64_t, 3> expected = {x, y, z};
    EXPECT_EQ(LeafWindow::offsets(LeafWindow::key(x, y, z)), expected);
  }
}

TEST(LeafWindow, LeavesOutsideAreFarAndEachIsThereOnce) {
  const LeafWindow window(LeafGrid(1.0), {0, 0, 0});
  const float end = 1 << 20;
  const PointColumns points({{0.5F, 0, 0}, {end, 0, 0}, {end, 0, 0}, {-end, 0, 0}, {0, -3e6F, 0}});
  std::size_t near = 0;
  const FarLeaves far = window.for_each_block(
      points, RigidTransform{}, [&](const std::uint64_t*, std::size_t count) { near += count; });
  EXPECT_EQ(near, 2U);  // The window is half open, as its leaves are.
  const FarLeaves expected = {{0, -3000000, 0}, {1 << 20, 0, 0}};
  EXPECT_EQ(far, expected);
  EXPECT_EQ(count_new(far, {{1 << 20, 0, 0}}), 1);
}

TEST(LeafWindow, HoldsNoCloudThatIsNotFiniteAndNoneAtItsBorder) {
  const LeafWindow window(LeafGrid(1.0), {0, 0, 0});
  const Points near = {{1, 2, 3}, {-4, 5, -6}};
  EXPECT_TRUE(window.contains(PointColumns(near), RigidTransform{}));
  EXPECT_FALSE(window.contains(PointColumns(near), shifted({1 << 20, 0, 0})));
  for (const float wrong :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const PointColumns points({{1, 2, 3}, {0, wrong, 0}, {1, 1, 1}});
    EXPECT_FALSE(window.contains(points, RigidTransform{}));
    EXPECT_THROW(window.for_each_block(points, {}, [](const std::uint64_t*, std::size_t) {}),
                 StageError);
  }
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(window.contains(PointColumns(near), shifted({0, not_a_number, 0})));
}

}  // namespace
}  // namespace croon

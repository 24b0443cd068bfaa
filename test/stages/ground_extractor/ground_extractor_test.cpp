#include "framework/stage/ground_extractor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

params::Slot<GroundExtractor> extractor(const std::string& name, const std::string& more = "") {
  return test::stage<GroundExtractor>("{\"type\": \"" + name + "\"" + more + "}");
}

Ground extracted(const GroundExtractor& stage, const Points& cloud, std::uint64_t seed = 1) {
  Rng rng = test::test_rng(seed);
  return stage.extract(cloud, rng);
}

bool same_bits(const Ground& a, const Ground& b) {
  return a.plane.normal == b.plane.normal && a.plane.offset_m == b.plane.offset_m &&
         a.is_ground == b.is_ground;
}

/// The plane in the target's frame.
Plane mapped(const RigidTransform& T_target_source, const Plane& plane) {
  const Eigen::Vector3d normal = T_target_source.rotation * plane.normal;
  return {normal, plane.offset_m - normal.dot(T_target_source.translation)};
}

/// `plane` with its normal on the side of that of `other`.
Plane turned_to(const Plane& plane, const Plane& other) {
  return plane.normal.dot(other.normal) < 0.0 ? plane.flipped() : plane;
}

double angle_deg(const Plane& a, const Plane& b) {
  return deg_from_rad(std::asin(std::min(1.0, a.normal.cross(b.normal).norm())));
}

/// The ground of test::random_street.
Plane street_ground() { return {Eigen::Vector3d::UnitZ(), 2.0}; }

/// T_sensor_street of a sensor that is turned anyhow, 0.5 to 4 m above the road.
RigidTransform pose_above_road(Rng& rng) {
  RigidTransform T_street_sensor = test::random_pose(rng, 3.0);
  T_street_sensor.translation.z() = rng.uniform(-1.5, 2.0);
  return T_street_sensor.inverse();
}

/// All ground extractors that this build has.
class EveryGroundExtractor : public testing::TestWithParam<std::string> {};

TEST_P(EveryGroundExtractor, FindsTheGroundOfAStreetUnderAnyPose) {
  Rng rng = test::test_rng();
  const auto stage = extractor(GetParam());
  for (int i = 0; i < 20; ++i) {
    const RigidTransform T_sensor_street = pose_above_road(rng);
    const Points street = test::random_street(rng, i, 15000, 0.01);
    const Ground ground = extracted(*stage, transformed(street, T_sensor_street));
    const Plane expected = mapped(T_sensor_street, street_ground());
    const Plane found = turned_to(ground.plane, expected);
    EXPECT_LT(angle_deg(found, expected), 0.03);
    // The feet of walls lie on one side of the ground and lift the plane by this much.
    EXPECT_NEAR(found.signed_distance(T_sensor_street * Eigen::Vector3d(0, 0, -2.0)), 0.0, 0.003);
  }
}

TEST_P(EveryGroundExtractor, GroundIsWhatIsNearThePlane) {
  Rng rng = test::test_rng(2);
  const Points street = test::random_street(rng, 7, 15000, 0.01);
  const Ground ground = extracted(*extractor(GetParam(), R"(, "threshold_m": 0.15)"), street);
  ASSERT_EQ(ground.is_ground.size(), street.size());
  EXPECT_NEAR(ground.plane.normal.norm(), 1.0, 1e-12);
  for (std::size_t i = 0; i < street.size(); ++i) {
    const double distance_m = std::abs(ground.plane.signed_distance(street[i].cast<double>()));
    EXPECT_EQ(ground.is_ground[i] != 0, distance_m <= 0.15);
  }
}

TEST_P(EveryGroundExtractor, ARotatedCloudHasTheRotatedGround) {
  Rng rng = test::test_rng(3);
  const auto stage = extractor(GetParam());
  for (int i = 0; i < 10; ++i) {
    const Points street = test::random_street(rng, i, 15000, 0.01);
    const RigidTransform T = pose_above_road(rng);
    const Plane expected = mapped(T, extracted(*stage, street).plane);
    const Plane found = turned_to(extracted(*stage, transformed(street, T)).plane, expected);
    EXPECT_LT(angle_deg(found, expected), 0.002);
    EXPECT_NEAR(found.offset_m, expected.offset_m, 0.0005);
  }
}

TEST_P(EveryGroundExtractor, SameSeedSameBitsOnAnyThreadAfterAnyCall) {
  Rng rng = test::test_rng(4);
  const auto stage = extractor(GetParam());
  const Points street = test::random_street(rng, 1, 8000, 0.02);
  const Points other = test::random_street(rng, 2, 5000, 0.02);
  const Ground first = extracted(*stage, street);
  extracted(*stage, other, 9);
  EXPECT_TRUE(same_bits(first, extracted(*stage, street)));
  Ground elsewhere;
  std::thread([&] { elsewhere = extracted(*stage, street); }).join();
  EXPECT_TRUE(same_bits(first, elsewhere));
}

TEST_P(EveryGroundExtractor, CloudsWithoutAPlaneAreRefused) {
  Rng rng = test::test_rng(5);
  const auto stage = extractor(GetParam());
  const Eigen::Vector3f point(1.0F, 2.0F, 3.0F), step(0.5F, -0.25F, 0.125F);
  Points line, two_places;
  for (int i = 0; i < 300; ++i) {
    line.push_back(point + static_cast<float>(i) * step);
    two_places.push_back(i % 2 == 0 ? point : step);
  }
  EXPECT_THROW(extracted(*stage, {}), StageError);
  EXPECT_THROW(extracted(*stage, {point}), StageError);
  EXPECT_THROW(extracted(*stage, {point, step}), StageError);
  EXPECT_THROW(extracted(*stage, Points(3, point)), StageError);
  EXPECT_THROW(extracted(*stage, Points(5000, point)), StageError);
  EXPECT_THROW(extracted(*stage, line), StageError);
  EXPECT_THROW(extracted(*stage, two_places), StageError);
  const auto demanding = extractor(GetParam(), R"(, "min_inlier_ratio": 0.9)");
  EXPECT_THROW(extracted(*demanding, test::random_cloud(rng, 3000, 10.0)), StageError);
}

TEST_P(EveryGroundExtractor, ThreePointsAreAGroundOrAreRefused) {
  Rng rng = test::test_rng(6);
  const auto stage = extractor(GetParam());
  for (int i = 0; i < 100; ++i) {
    const Points three = test::random_cloud(rng, 3, 5.0);
    try {
      const Ground ground = extracted(*stage, three);
      EXPECT_EQ(ground.is_ground, std::vector<std::uint8_t>(3, 1));
    } catch (const StageError&) {
      EXPECT_NE(GetParam(), "ransac");  // The others ask for more points around a point.
    }
  }
}

TEST_P(EveryGroundExtractor, DuplicatesChangeNothingOfTheGround) {
  Rng rng = test::test_rng(7);
  Points street = test::random_street(rng, 3, 8000, 0.005);
  const Points copy = street;
  for (int i = 0; i < 3; ++i) street.insert(street.end(), copy.begin(), copy.end());
  const Plane found = turned_to(extracted(*extractor(GetParam()), street).plane, street_ground());
  EXPECT_LT(angle_deg(found, street_ground()), 0.03);
  EXPECT_NEAR(found.offset_m, 2.0, 0.003);
}

TEST_P(EveryGroundExtractor, PointsThatAreNotFiniteAreRefusedOrAreNotGround) {
  Rng rng = test::test_rng(8);
  Points street = test::random_street(rng, 3, 8000, 0.01);
  for (std::size_t i = 0; i < street.size(); i += 100) {
    street[i].y() = std::numeric_limits<float>::quiet_NaN();
  }
  try {
    const Ground ground = extracted(*extractor(GetParam()), street);
    EXPECT_LT(angle_deg(ground.plane, street_ground()), 0.05);
    for (std::size_t i = 0; i < street.size(); i += 100) EXPECT_EQ(ground.is_ground[i], 0);
  } catch (const StageError&) {
    EXPECT_NE(GetParam(), "ransac");  // The others lay the points into a grid, which refuses NaN.
  }
}

TEST_P(EveryGroundExtractor, FitsTheFinalPlaneWithinTheSlab) {
  // A wider final slab is the slab itself.
  Rng scene = test::test_rng(3);
  const Points street = test::random_street(scene, 3, 6000, 0.01);
  const auto plane_of = [&](const std::string& parameters) {
    Rng rng = test::test_rng();
    return extractor(GetParam(), parameters)->extract(street, rng).plane;
  };
  const Plane wide = plane_of(R"(, "threshold_m": 0.1, "refit_threshold_m": 0.2)");
  const Plane equal = plane_of(R"(, "threshold_m": 0.1, "refit_threshold_m": 0.1)");
  EXPECT_EQ(wide.normal, equal.normal);
  EXPECT_EQ(wide.offset_m, equal.offset_m);
}

/// A road with a wall beside it that has more points, as a lorry's side near a sensor has.
Points road_beside_a_wall(Rng& rng) {
  Points cloud = test::random_street(rng, 5, 15000, 0.01);
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d point{rng.uniform(-4.0, 4.0), 2.0, rng.uniform(-1.8, 1.0)};
    cloud.push_back((point + 0.01 * Eigen::Vector3d(0, rng.normal(), 0)).cast<float>());
  }
  return cloud;
}

TEST(GroundThatIsTheGround, IsTheRoadIfAWallHasMorePoints) {
  Rng rng = test::test_rng(9);
  for (int i = 0; i < 5; ++i) {
    const RigidTransform T = pose_above_road(rng);
    const Points cloud = transformed(road_beside_a_wall(rng), T);
    const Plane road = mapped(T, street_ground());
    EXPECT_GT(angle_deg(extracted(*extractor("ransac"), cloud).plane, road), 80.0);
    for (const char* const name : {"plausible_plane", "patchwork"}) {
      const Plane found = extracted(*extractor(name), cloud).plane;
      EXPECT_LT(angle_deg(found, road), 0.05) << name;
      EXPECT_LT(std::abs(turned_to(found, road).offset_m - road.offset_m), 0.005) << name;
    }
  }
}

TEST(CgalEfficientRansac, RefusesClustersThatNeedTooMuchMemory) {
  const std::string name = "cgal_efficient_ransac";
  const std::vector<std::string> names = registry().names("ground_extractor");
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    GTEST_SKIP() << "this build has no CGAL";
  }
  Rng rng = test::test_rng(11);
  const Points street = test::random_street(rng, 1, 8000, 0.02);
  try {
    extracted(*extractor(name, R"(, "cluster_distance_m": 0.001)"), street);
    FAIL() << "nothing was thrown";
  } catch (const StageError& error) {
    EXPECT_NE(
        std::string(error.what()).find("cluster_distance_m 0.001 is too small for a plane of "),
        std::string::npos)
        << error.what();
  }
  EXPECT_NO_THROW(extracted(*extractor(name), street));
}

TEST(Patchwork, TakesTheSensorsZForUpOnlyIfAsked) {
  Rng rng = test::test_rng(10);
  const auto z_up = extractor("patchwork", R"(, "up": "sensor_z")");
  const Points level = test::random_street(rng, 5, 15000, 0.01);
  EXPECT_LT(angle_deg(extracted(*z_up, level).plane, street_ground()), 0.03);
  for (const double pitch_deg : {50.0, 90.0}) {
    const RigidTransform T = {rotation_from_rpy({0.0, rad_from_deg(pitch_deg), 0.0}), {0, 0, 0}};
    const Points tilted = transformed(level, T);
    EXPECT_LT(
        angle_deg(extracted(*extractor("patchwork"), tilted).plane, mapped(T, street_ground())),
        0.03);
    EXPECT_THROW(extracted(*z_up, tilted), StageError);
  }
}

INSTANTIATE_TEST_SUITE_P(Registered, EveryGroundExtractor,
                         testing::ValuesIn(registry().names("ground_extractor")),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace croon

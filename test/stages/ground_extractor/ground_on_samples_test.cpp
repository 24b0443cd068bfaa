#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "framework/stage/ground_extractor.hpp"
#include "framework/stage/rig_files.hpp"
#include "test/support/data_root.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

/// How well the sensors' grounds lie on the reference's, by the rig's poses.
struct Agreement {
  double worst_deg = 0.0;
  double worst_m = 0.0;
};

Plane ground_plane(const GroundExtractor& extractor, const std::filesystem::path& file) {
  Rng rng = test::test_rng();
  return extractor.extract(read_point_cloud(file).points, rng).plane;
}

Agreement agreement(const GroundExtractor& extractor, const std::filesystem::path& scene,
                    const RigPoses& poses) {
  const Plane top = ground_plane(extractor, scene / "top.pcd");
  Agreement worst;
  for (const auto& [sensor, T_top_sensor] : poses) {
    Plane plane = ground_plane(extractor, scene / (sensor + ".pcd"));
    plane.normal = T_top_sensor.rotation * plane.normal;
    plane.offset_m -= plane.normal.dot(T_top_sensor.translation);
    if (plane.normal.dot(top.normal) < 0.0) plane = plane.flipped();
    const double sine = std::min(1.0, plane.normal.cross(top.normal).norm());
    worst.worst_deg = std::max(worst.worst_deg, deg_from_rad(std::asin(sine)));
    worst.worst_m = std::max(worst.worst_m, std::abs(plane.offset_m - top.offset_m));
  }
  return worst;
}

class GroundOnSamples : public testing::TestWithParam<std::string> {};

TEST_P(GroundOnSamples, SimulatedSensorsSeeOneGround) {
  CROON_SKIP_WITHOUT_DATA();
  const auto extractor = test::stage<GroundExtractor>("{\"type\": \"" + GetParam() + "\"}");
  const std::filesystem::path rig = test::data_root() / "opencalib" / "carla";
  for (const char* scene : {"004069", "004553"}) {
    const Agreement worst = agreement(*extractor, rig / scene, read_rig_poses(rig / "truth.json"));
    EXPECT_LT(worst.worst_deg, 0.03) << scene;  // Measured: 0.012.
    EXPECT_LT(worst.worst_m, 0.004) << scene;   // Measured: 0.0014.
  }
}

TEST_P(GroundOnSamples, RealSensorsSeeRoughlyOneGround) {
  CROON_SKIP_WITHOUT_DATA();
  // A real street is no plane: each sensor sees another part of its camber, and the nominal pose is
  // good to 0.3 degrees.
  const auto extractor = test::stage<GroundExtractor>("{\"type\": \"" + GetParam() + "\"}");
  const std::filesystem::path rig = test::data_root() / "opencalib" / "real";
  for (const char* scene : {"0001", "0002"}) {
    const Agreement worst =
        agreement(*extractor, rig / scene, read_rig_poses(rig / "nominal.json"));
    EXPECT_LT(worst.worst_deg, 2.0) << scene;
    EXPECT_LT(worst.worst_m, 0.1) << scene;
  }
}

INSTANTIATE_TEST_SUITE_P(Registered, GroundOnSamples,
                         testing::ValuesIn(registry().names("ground_extractor")),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace croon

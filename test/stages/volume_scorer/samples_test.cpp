#include <gtest/gtest.h>

#include "framework/params/slot.hpp"
#include "framework/stage/dataset.hpp"
#include "test/stages/volume_scorer/scorers.hpp"
#include "test/support/data_root.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

TEST(VolumeScorers, CountLikeTheSetOnTheAuthorsSamples) {
  CROON_SKIP_WITHOUT_DATA();
  for (const std::string rig : {"opencalib/carla", "opencalib/real"}) {
    const auto dataset = test::stage<Dataset>(R"({"type": "opencalib", "path": ")" + rig + R"("})");
    const Scene scene = dataset->scenes(test::data_root()).at(0);
    const Points reference = scene.reference.load().points;
    Rng rng = test::test_rng();
    const SensorScan& sensor = scene.sensors.front();
    SCOPED_TRACE(rig + " " + scene.name + " " + sensor.sensor);
    const RigidTransform pose = sensor.truth ? *sensor.truth : sensor.nominal.value();
    test::expect_equal_counts(reference, sensor.load().points,
                              {pose, test::pose_near(rng, pose, 45.0, 0.1)}, 0.05);
  }
}

}  // namespace
}  // namespace croon

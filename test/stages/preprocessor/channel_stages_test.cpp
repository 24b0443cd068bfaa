// The preprocessors that need a channel.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/simulation/simulated_scene.hpp"
#include "framework/stage/preprocessor.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

using ::testing::HasSubstr;

PointCloud applied(const std::string& json, const PointCloud& cloud) {
  return test::stage<Preprocessor>(json)->apply(cloud);
}

std::string error_of(const std::string& json, const PointCloud& cloud) {
  try {
    applied(json, cloud);
  } catch (const StageError& error) {
    return error.what();
  }
  return "";
}

TEST(IntensityThreshold, KeepsWhatIsWithinBoundsWithItsChannels) {
  Rng rng = test::test_rng();
  const PointCloud cloud = test::measured(test::random_cloud(rng, 500, 10.0));
  const PointCloud kept =
      applied(R"({"type": "intensity_threshold", "min": 20, "max": 40})", cloud);
  const std::vector<double> all = channel_values(cloud, kIntensity);
  EXPECT_EQ(kept.size(), static_cast<std::size_t>(std::count_if(
                             all.begin(), all.end(), [](double x) { return x >= 20 && x <= 40; })));
  for (const double intensity : channel_values(kept, kIntensity)) {
    EXPECT_GE(intensity, 20.0);
    EXPECT_LE(intensity, 40.0);
  }
}

TEST(IntensityThreshold, NamesTheChannelThatIsMissing) {
  EXPECT_THAT(error_of(R"({"type": "intensity_threshold"})", Points{{1, 2, 3}}),
              HasSubstr("no channel \"intensity\""));
}

/// The JSON of a deskewing by `velocity`.
std::string deskew_json(const Twist& velocity) {
  const auto list = [](const Eigen::Vector3d& v) {
    std::ostringstream text;
    text.precision(17);
    text << "[" << v.x() << ", " << v.y() << ", " << v.z() << "]";
    return text.str();
  };
  return R"({"type": "deskew", "linear_mps": )" + list(velocity.linear_mps) +
         R"(, "angular_degps": )" + list(velocity.angular_radps * (180.0 / kPi)) + "}";
}

/// Sensors without noise on a car whose body, which moves with them, they do not see.
std::shared_ptr<simulation::Recipe> sweeping_recipe() {
  auto recipe = std::make_shared<simulation::Recipe>();
  recipe->rig = simulation::rigs().front().second;
  recipe->rig.body.is_visible = false;
  recipe->noise.moves_during_scan = true;
  return recipe;
}

/// The share of the points of `cloud` that lie within a millimetre of a surface of the world as it
/// is at time 0, seen from the sensor.
double share_on_world(const simulation::SimulatedScene& scene, const RigidTransform& T_world_sensor,
                      const PointCloud& cloud) {
  constexpr double kBefore_m = 0.05;
  std::vector<simulation::Ray> rays;
  for (const Eigen::Vector3f& p : cloud.points) {
    const Eigen::Vector3d point = T_world_sensor * p.cast<double>();
    const Eigen::Vector3d direction = (point - T_world_sensor.translation).normalized();
    rays.push_back({point - kBefore_m * direction, direction, 0.0});
  }
  std::size_t near = 0;
  for (const simulation::Hit& hit : scene.caster().cast(rays, 0.0, 1.0)) {
    // Between the point and the surface along its normal.
    const double distance_m = std::abs(hit.range_m - kBefore_m) * hit.incidence_cos;
    if (hit.is_there() && distance_m < 1e-3) ++near;
  }
  return static_cast<double>(near) / static_cast<double>(cloud.size());
}

TEST(Deskew, UndoesTheDistortionOfTheSimulationToAMillimetre) {
  const auto recipe = sweeping_recipe();
  int compared = 0;
  for (std::uint64_t index = 0; compared <= 5; ++index) {
    const simulation::SimulatedScene scene(recipe, index);
    if (scene.world().car.motion.speed_mps < 3.0) continue;
    for (const auto& [name, mounting] : recipe->rig.sensors) {
      const RigidTransform T_world_sensor = scene.world().car.T_world_body *
                                            recipe->rig.T_car_reference() *
                                            mounting.T_reference_sensor();
      const PointCloud distorted = scene.scan_of(name);
      const PointCloud restored = applied(deskew_json(scene.velocity_of(name)), distorted);
      // The rest is on other cars, which move by themselves.
      EXPECT_GT(share_on_world(scene, T_world_sensor, restored), 0.9) << index << name;
      EXPECT_LT(share_on_world(scene, T_world_sensor, distorted),
                0.95 * share_on_world(scene, T_world_sensor, restored))
          << index << name;
      ++compared;
    }
  }
}

TEST(Deskew, IsUndoneByTheOppositeVelocity) {
  // A twist's screw maps onto itself, so the motion back is that of the opposite velocity.
  Rng rng = test::test_rng();
  const PointCloud cloud = test::measured(test::random_cloud(rng, 2000, 30.0));
  const Twist velocity = {{0.1, -0.2, 0.5}, {12.0, -1.0, 0.3}};
  const PointCloud there = applied(deskew_json(velocity), cloud);
  const PointCloud back =
      applied(deskew_json({-velocity.angular_radps, -velocity.linear_mps}), there);
  double farthest = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_LT((back.points[i] - cloud.points[i]).norm(), 1e-4F);
    farthest = std::max(farthest, static_cast<double>((there.points[i] - cloud.points[i]).norm()));
  }
  EXPECT_GT(farthest, 0.01);
}

TEST(Deskew, MovesToTheTimeThatIsAsked) {
  PointCloud cloud = Points(3, Eigen::Vector3f(1, 0, 0));
  cloud.channels = {make_channel(kTime, std::vector<double>{10.0, 10.1, 10.2})};
  const auto x_of = [&](const std::string& time) {
    const Points points = applied(R"({"type": "deskew", "linear_mps": [10, 0, 0],
                                      "reference_time": ")" +
                                      time + "\"}",
                                  cloud)
                              .points;
    return std::vector{points[0].x(), points[1].x(), points[2].x()};
  };
  using ::testing::FloatNear;
  EXPECT_THAT(x_of("first"),
              ::testing::ElementsAre(1.0F, FloatNear(2, 1e-4F), FloatNear(3, 1e-4F)));
  EXPECT_THAT(x_of("middle"), ::testing::ElementsAre(FloatNear(0, 1e-4F), FloatNear(1, 1e-4F),
                                                     FloatNear(2, 1e-4F)));
  EXPECT_THAT(x_of("zero"), ::testing::Contains(FloatNear(101, 1e-3F)));
}

TEST(Deskew, AcceptsTimesOfAnyUnitInWhichAScanHasItsLength) {
  PointCloud cloud = Points(1001, Eigen::Vector3f(1, 0, 0));
  const auto error_of_scan = [&](double length) {
    std::vector<double> times;
    for (int i = 0; i <= 1000; ++i) times.push_back(1e-3 * i * length);
    cloud.channels = {make_channel(kTime, times)};
    return error_of(R"({"type": "deskew", "reference_time": "middle"})", cloud);
  };
  for (const double length : {0.0, 0.1, 2.0, 100.0, 1e5, 1e8}) {
    EXPECT_EQ(error_of_scan(length), "") << length;
  }
  EXPECT_THAT(error_of_scan(1e11), HasSubstr("from the reference time"));
  EXPECT_THAT(error_of_scan(1e-5), HasSubstr("the scan lasts less than 0.5 ms"));
  cloud = Points(2, Eigen::Vector3f(1, 0, 0));
  cloud.channels = {make_channel(kTime, std::vector<std::int64_t>{0, 15000000000})};
  EXPECT_THAT(error_of(R"({"type": "deskew", "reference_time": "middle"})", cloud),
              HasSubstr("the scan lasts longer than 10 s"));
}

TEST(Deskew, RefusesTimesThatAreOfNoScan) {
  PointCloud cloud = Points(1, Eigen::Vector3f(1, 0, 0));
  EXPECT_THAT(error_of(R"({"type": "deskew"})", cloud), HasSubstr("no channel \"time\""));
  const std::pair<double, const char*> cases[] = {{1.6e9, "reference_time"},
                                                  {-100.0, "reference_time"},
                                                  {std::nan(""), "finite"},
                                                  {HUGE_VAL, "finite"}};
  for (const auto& [time_s, message] : cases) {
    cloud.channels = {make_channel(kTime, std::vector<double>{time_s})};
    EXPECT_THAT(error_of(R"({"type": "deskew"})", cloud), HasSubstr(message)) << time_s;
  }
}

}  // namespace
}  // namespace croon

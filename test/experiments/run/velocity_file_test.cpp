#include <gtest/gtest.h>

#include "experiments/run/given_velocities.hpp"
#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

using Lines = std::vector<std::string>;

const std::string kWithStds = velocity_header_with_stds();

VelocityTable read_velocities(const std::string& header, const Lines& lines, const Lines& scenes) {
  const test::TempFolder folder;
  std::string bytes = header + "\n";
  for (const std::string& line : lines) bytes += line + "\n";
  return read_velocity_file(folder.write("v.csv", bytes), scenes, scenes);
}

/// Faults as "where: message".
Lines velocity_faults(const std::string& header, const Lines& lines, const Lines& scenes = {"a"}) {
  Lines faults;
  try {
    read_velocities(header, lines, scenes);
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults()) {
      faults.push_back(Fault{"", fault.where, fault.message}.line());
    }
  }
  return faults;
}

TEST(VelocityFile, BeginsAsTheDocumentationSays) {
  EXPECT_EQ(velocity_header(),
            "scene,vx_mps,vy_mps,vz_mps,roll_rate_degps,pitch_rate_degps,yaw_rate_degps");
  EXPECT_EQ(kWithStds, velocity_header() +
                           ",vx_std_mps,vy_std_mps,vz_std_mps,roll_rate_std_degps,"
                           "pitch_rate_std_degps,yaw_rate_std_degps");
}

TEST(VelocityFile, HasAVelocityForEachScene) {
  const VelocityTable table = read_velocities(
      velocity_header(), {"b,1,2,3,4,\"5\",6", "\"a,1\",-1,0,0,0,0,90"}, {"a,1", "b"});
  EXPECT_EQ(table.sha256.size(), 64U);
  const GivenMotion& b = table.motions.at("b");
  EXPECT_EQ(b.velocity.linear_mps, Eigen::Vector3d(1, 2, 3));
  EXPECT_LT((b.velocity.angular_radps - Eigen::Vector3d(4, 5, 6) * rad_from_deg(1.0)).norm(),
            1e-15);
  EXPECT_FALSE(b.stds);
  EXPECT_NEAR(table.motions.at("a,1").velocity.angular_radps.z(), rad_from_deg(90.0), 1e-15);
}

TEST(VelocityFile, MayHaveStandardDeviations) {
  const GivenMotion a =
      read_velocities(kWithStds, {"a,1,2,3,4,5,6,0.1,0.2,0.3,1,2,3"}, {"a"}).motions.at("a");
  Vector6d stds;
  stds << Eigen::Vector3d(1, 2, 3) * rad_from_deg(1.0), 0.1, 0.2, 0.3;
  ASSERT_TRUE(a.stds);
  EXPECT_TRUE(a.stds->isApprox(stds, 1e-12));
}

TEST(VelocityFile, NamesWhatIsWrongWithALine) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"a,1,2,3,4,5", "expected 7 fields, found 6"},
      {"a,1,2,3,4,5,x", "expected a number, found \"x\""},
      {"a,1,2,inf,4,5,6", "expected a finite number, found \"inf\""},
      {"a,1001,2,3,4,5,6", "expected a number from -1000 to 1000 m/s, found \"1001\""},
      {"a,1,2,3,4,5,-3601", "expected a number from -3600 to 3600 deg/s, found \"-3601\""},
      {"a,1,2,3,4,5,6\"\"", "expected no quote inside a field, found \"6\"\"\""},
      {"a,1,2,3,4,5,\"6\"7", "expected a comma after a quoted field, found \"7\""},
      {"a,1,2,3,4,5,\"6", "expected a second quote, found \"a,1,2,3,4,5,\"6\""},
      {"aa,1,2,3,4,5,6", "expected a scene of the dataset, found \"aa\"; did you mean \"a\"?"}};
  for (const auto& [line, message] : cases) {
    EXPECT_EQ(velocity_faults(velocity_header(), {line}), Lines{"line 2: " + message});
  }
  EXPECT_EQ(velocity_faults(kWithStds, {"a,1,2,3,4,5,6,0.1,0.1,0,1,1,1"}),
            Lines{"line 2: expected a standard deviation above 0, found \"0\""});
  EXPECT_EQ(velocity_faults(velocity_header(), {"a,1,2,3,4,5,6", "a,1,2,3,4,5,6"}),
            Lines{"line 3: expected each scene once, found \"a\" again"});
}

TEST(VelocityFile, MayHaveScenesThatNoTrialNeeds) {
  const test::TempFolder folder;
  const auto path = folder.write("v.csv", velocity_header() + "\na,1,2,3,4,5,6\nb,1,2,3,4,5,6\n");
  EXPECT_EQ(read_velocity_file(path, {"a", "b", "c"}, {"a"}).motions.size(), 2U);
}

TEST(VelocityFile, WantsItsHeaderAndEveryScene) {
  EXPECT_EQ(velocity_faults("scene,vx", {}),
            Lines{"line 1: expected \"" + velocity_header() + "\" or \"" + kWithStds +
                  "\", found \"scene,vx\""});
  EXPECT_EQ(velocity_faults(velocity_header(), {"a,1,2,3,4,5,6"}, {"a", "b"}),
            Lines{"expected a velocity of scene \"b\", found none"});
  const Lines many = velocity_faults(
      velocity_header(), {}, Lines{"a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l"});
  ASSERT_EQ(many.size(), 11U);
  EXPECT_EQ(many.back(), "and 2 more faults");
}

}  // namespace
}  // namespace croon::experiments

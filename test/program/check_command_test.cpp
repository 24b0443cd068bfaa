// croon check on the authors' samples: true poses, and poses that are off.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/base/whole_file.hpp"
#include "test/program/program.hpp"
#include "test/support/data_root.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

std::string carla() { return (test::data_root() / "opencalib" / "carla").string(); }

/// Checks the poses in `file` by clouds of a scene: those of the reference and of `sensors`.
Answer check(const std::string& file, std::vector<std::string> sensors) {
  std::string arguments = "check '" + file + "' --quiet";
  sensors.insert(sensors.begin(), "top");
  for (const std::string& sensor : sensors) {
    arguments += " '" + carla() + "/004069/" + sensor + ".pcd'";
  }
  return croon(arguments);
}

TEST(CheckCommand, FindsTruePosesRight) {
  CROON_SKIP_WITHOUT_DATA();
  const Answer answer = check(carla() + "/truth.json", {"left"});
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_NE(answer.text.find("RIGHT        left: within"), std::string::npos) << answer.text;
}

TEST(CheckCommand, NamesTheDegreeOfFreedomThatIsOff) {
  CROON_SKIP_WITHOUT_DATA();
  nlohmann::json poses = nlohmann::json::parse(read_whole_file(carla() + "/truth.json"));
  const auto add = [&](const char* sensor, const char* key, int index, double offset) {
    nlohmann::json& number = poses[sensor][key][static_cast<std::size_t>(index)];
    number = number.get<double>() + offset;
  };
  add("left", "rotation_rpy_deg", 2, 0.3);
  add("back", "translation_m", 0, 0.05);
  const test::TempFolder folder;
  const Answer answer = check(folder.write("poses.json", poses.dump()).string(), {"left", "back"});
  EXPECT_EQ(answer.code, 3) << answer.text;
  EXPECT_NE(answer.text.find("WRONG        left: yaw is off by +0."), std::string::npos)
      << answer.text;
  EXPECT_NE(answer.text.find("WRONG        back: x is off by +5"), std::string::npos)
      << answer.text;
}

TEST(CheckCommand, RefusesAFileWithoutThePoses) {
  CROON_SKIP_WITHOUT_DATA();
  const test::TempFolder folder;
  const std::string file = folder
                               .write("poses.json", R"({"lft": {"rotation_rpy_deg": [0, 0, 0],
                                              "translation_m": [0, 0, 0]}})")
                               .string();
  const Answer answer = check(file, {"left"});
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("expected a pose of \"left\", found none; did you mean \"lft\"?"),
            std::string::npos)
      << answer.text;
  EXPECT_EQ(check("not_there.json", {"left"}).code, 2);
}

}  // namespace
}  // namespace croon::experiments

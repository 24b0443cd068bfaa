#include "registry/help.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "framework/base/error.hpp"
#include "registry/registry.hpp"
#include "test/support/nested_stage.hpp"

namespace croon {
namespace {

/// The words of the InputError that asking for `which` throws.
std::string refusal_of(const std::string& which) {
  try {
    stages_help(registry(), which, HelpFormat::text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(StagesHelp, TableHasALineForEveryStage) {
  const std::string table = stages_help(registry(), "", HelpFormat::text);
  EXPECT_EQ(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')),
            registry().entries().size());
  for (const StageEntry& entry : registry().entries()) {
    EXPECT_NE(table.find(entry.summary), std::string::npos) << entry.name;
  }
}

TEST(StagesHelp, ShowsEveryParameterInEveryFormat) {
  for (const StageEntry& entry : registry().entries()) {
    for (const HelpFormat format : {HelpFormat::text, HelpFormat::json, HelpFormat::markdown}) {
      const std::string page = stages_help(registry(), entry.kind + "/" + entry.name, format);
      EXPECT_EQ(page.back(), '\n');
      EXPECT_NE(page.find(entry.summary), std::string::npos) << entry.name;
      for (const params::ParameterDoc& parameter : entry.parameters) {
        EXPECT_NE(page.find(parameter.key), std::string::npos) << entry.name;
        EXPECT_NE(page.find(parameter.sentence), std::string::npos) << entry.name;
      }
    }
  }
}

/// Numbers of several units, whose names say none, have their order and units in the sentence.
TEST(StagesHelp, SaysTheUnitOfEachNumberOfAListWithoutOneInItsName) {
  for (const StageEntry& entry : registry().entries()) {
    for (const params::ParameterDoc& parameter : entry.parameters) {
      if (parameter.type != params::ParameterType::numbers) continue;
      const std::string& key = parameter.key;
      const std::string unit = key.substr(key.rfind('_') + 1);
      const std::set<std::string> units = {"m", "mps", "degps", "deg", "s", "ratio"};
      if (units.count(unit) > 0) continue;
      EXPECT_NE(parameter.sentence.find("the first in "), std::string::npos) << key;
      EXPECT_NE(parameter.sentence.find("the second in "), std::string::npos) << key;
    }
  }
}

TEST(StagesHelp, JsonHoldsTheTable) {
  const auto list = nlohmann::json::parse(stages_help(registry(), "", HelpFormat::json));
  ASSERT_EQ(list.size(), registry().entries().size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const StageEntry& entry = registry().entries()[i];
    EXPECT_EQ(list[i]["kind"], entry.kind);
    EXPECT_EQ(list[i]["name"], entry.name);
    ASSERT_EQ(list[i]["parameters"].size(), entry.parameters.size());
    for (std::size_t k = 0; k < entry.parameters.size(); ++k) {
      const nlohmann::json& shown = list[i]["parameters"][k];
      EXPECT_EQ(shown["key"], entry.parameters[k].key);
      EXPECT_EQ(shown["required"], entry.parameters[k].is_required);
      EXPECT_EQ(shown.contains("default"),
                !entry.parameters[k].is_required && !entry.parameters[k].is_optional);
    }
  }
}

/// The help on a stage that has groups and maps.
std::string nested_help(HelpFormat format) {
  Catalogue catalogue;
  catalogue.add(test::nested_stage());
  return stages_help(catalogue, "dataset/nested", format);
}

TEST(StagesHelp, ShowsTheParametersOfObjectsBelowThem) {
  for (const HelpFormat format : {HelpFormat::text, HelpFormat::markdown}) {
    const std::string page = nested_help(format);
    std::size_t end = 0;
    for (const char* path : {"model", "model.rings", "mix", "mix.urban", "rig", "rig.reference",
                             "rig.sensors", "rig.sensors.<name>.height_m",
                             "rig.sensors.<name>.model", "rig.sensors.<name>.model.far_m"}) {
      const std::string row = format == HelpFormat::text ? "\n  " + std::string(path) + ": "
                                                         : "\n| `" + std::string(path) + "` | ";
      const std::size_t place = page.find(row);
      ASSERT_NE(place, std::string::npos) << path << " in " << page;
      EXPECT_GE(place, end) << path;
      end = place;
    }
  }
}

TEST(StagesHelp, SaysWhatAnObjectTakes) {
  const std::string page = nested_help(HelpFormat::text);
  for (const char* line :
       {"model: one of coarse, fine, or an object, which may start from one (like); default "
        "\"coarse\"",
        "mix: an object; default {\"urban\":3,\"highway\":1}", "rig: one of pair, or an object",
        "rig.sensors: an object with a sensor's name for each key; required"}) {
    EXPECT_NE(page.find(line), std::string::npos) << line << "\n" << page;
  }
}

TEST(StagesHelp, JsonNestsTheParametersOfObjects) {
  const auto list = nlohmann::json::parse(nested_help(HelpFormat::json));
  const nlohmann::json& rig = list[0]["parameters"][2];
  EXPECT_EQ(rig["type"], "group");
  EXPECT_EQ(rig["choices"], nlohmann::json::array({"pair"}));
  const nlohmann::json& sensors = rig["members"][1];
  EXPECT_EQ(sensors["type"], "map");
  EXPECT_EQ(sensors["names"], "a sensor's name");
  EXPECT_EQ(sensors["members"][1]["members"][0]["key"], "rings");
  EXPECT_FALSE(list[0]["parameters"][0]["members"][0].contains("members"));
}

TEST(StagesHelp, KindShowsItsStagesAlone) {
  const auto list = nlohmann::json::parse(stages_help(registry(), "icp", HelpFormat::json));
  EXPECT_EQ(list.size(), registry().names("icp").size());
  for (const nlohmann::json& stage : list) EXPECT_EQ(stage["kind"], "icp");
}

TEST(StagesHelp, NamesTheNearestOfWhatIsUnknown) {
  EXPECT_EQ(refusal_of("ipc"), "expected a kind of stage, found \"ipc\"; did you mean \"icp\"?");
  EXPECT_EQ(refusal_of("icp/icpm"),
            "expected an icp stage, found \"icpm\"; did you mean \"icpn\"?");
  EXPECT_NE(refusal_of("icp/"), "");
  EXPECT_NE(refusal_of("/icpn"), "");
  EXPECT_NE(refusal_of("icp/icpn/more"), "");
}

}  // namespace
}  // namespace croon

#include "registry/help.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/base/error.hpp"
#include "registry/registry.hpp"

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
      EXPECT_EQ(shown.contains("default"), !entry.parameters[k].is_required);
    }
  }
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

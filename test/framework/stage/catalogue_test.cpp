#include "framework/stage/catalogue.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/params/json_file.hpp"
#include "framework/stage/preprocessor.hpp"
#include "framework/stage/step.hpp"

namespace croon {
namespace {

struct KeepParams {
  int count = 2;
};

class Keep final : public Preprocessor {
 public:
  explicit Keep(KeepParams params) : params_(params) {}
  PointCloud apply(const PointCloud& cloud) const override {
    return Points(cloud.points.begin(), cloud.points.begin() + params_.count);
  }

 private:
  KeepParams params_;
};

struct HolderParams {
  params::Slot<Preprocessor> one;
  std::vector<params::Slot<Preprocessor>> many;
};

class Holder final : public Step {
 public:
  explicit Holder(HolderParams) {}
  Estimate advance(Estimate estimate, Rng&) const override { return estimate; }
};

Catalogue catalogue() {
  Catalogue all;
  all.add(stage_entry<Holder>(
      "holder", "Holds.", "test",
      params::Table<HolderParams>{
          params::slot("one", &HolderParams::one, R"({"type": "keep", "count": 5})", "One."),
          params::slots("many", &HolderParams::many, "Many."),
      }));
  all.add(stage_entry<Keep>(
      "keep", "Keeps.", "test",
      params::Table<KeepParams>{params::integer("count", &KeepParams::count, {1, 9}, "How many.")},
      3));
  return all;
}

/// The resolved JSON of a step, and its faults.
std::string resolved(const std::string& text, std::vector<std::string>& lines) {
  const nlohmann::json value = params::parse_json(text, "f");
  std::vector<Fault> faults;
  const std::string json = catalogue().build("step", params::Node(value, "f", faults)).resolved;
  for (const Fault& fault : faults) lines.push_back(fault.line());
  return json;
}

TEST(Catalogue, CollectsTheVersionsOfAStageAndOfThoseInItsSlots) {
  const auto versions = [](const char* text) {
    const nlohmann::json value = params::parse_json(text, "f");
    std::vector<Fault> faults;
    return catalogue().build("step", params::Node(value, "f", faults)).versions;
  };
  const params::StageVersions both = {{"preprocessor/keep", 3}, {"step/holder", 1}};
  EXPECT_EQ(versions(R"({"step": "holder"})"), both);
  EXPECT_EQ(versions(R"({"step": "holder", "many": [{"type": "keep", "count": 1}]})"), both);
}

TEST(Catalogue, BuildsNestedStagesAndSaysThemInFull) {
  std::vector<std::string> lines;
  EXPECT_EQ(
      resolved(R"({"step": "holder", "many": [{"type": "keep"}]})", lines),
      R"({"step":"holder","one":{"type":"keep","count":5},"many":[{"type":"keep","count":2}]})");
  EXPECT_TRUE(lines.empty());
}

TEST(Catalogue, ResolvedJsonResolvesToItself) {
  std::vector<std::string> lines;
  const std::string once = resolved(R"({"step": "holder", "name": "h"})", lines);
  EXPECT_EQ(resolved(once, lines), once);
  EXPECT_TRUE(lines.empty());
}

TEST(Catalogue, NotesFaultsAtTheirPlace) {
  std::vector<std::string> lines;
  resolved(
      R"({"step": "holder", "one": {"type": "kepe"}, "many": [{"type": "keep", "count": 0}, 3, {}]})",
      lines);
  const std::vector<std::string> expected = {
      "f: /one/type: expected a preprocessor, found \"kepe\"; did you mean \"keep\"?",
      "f: /many/0/count: expected a whole number from 1 to 9, found 0",
      "f: /many/1: expected an object, found 3",
      "f: /many/2: the key \"type\" is missing",
  };
  EXPECT_EQ(lines, expected);
}

TEST(Catalogue, RefusesTwoStagesOfOneName) {
  Catalogue all = catalogue();
  StageEntry twin = *all.find("step", "holder");
  EXPECT_THROW(all.add(twin), std::logic_error);
  twin.name = "other";
  EXPECT_NO_THROW(all.add(twin));
}

TEST(Catalogue, RefusesTwoDescriptionsOfOneKind) {
  Catalogue all = catalogue();
  StageEntry twin = *all.find("step", "holder");
  twin.name = "other";
  twin.kind_order = 75;
  EXPECT_THROW(all.add(twin), std::logic_error);
  twin.kind_order = Step::kKindOrder;
  twin.kind_summary = "Another kind.";
  EXPECT_THROW(all.add(twin), std::logic_error);
}

/// A kind of stage that nothing but this file knows.
class Referee {
 public:
  using Kind = Referee;
  static constexpr const char* kKind = "judge";
  static constexpr const char* kKindSummary = "Judges.";
  static constexpr int kKindOrder = 25;
  virtual ~Referee() = default;
};

class Strict final : public Referee {
 public:
  explicit Strict(KeepParams) {}
};

TEST(Catalogue, TakesItsKindsFromItsStages) {
  Catalogue all = catalogue();
  all.add(stage_entry<Strict>("strict", "Judges strictly.", "test", params::Table<KeepParams>{}));
  std::vector<std::string> names;
  for (const StageKind& kind : all.kinds()) names.push_back(kind.name);
  EXPECT_EQ(names, (std::vector<std::string>{"preprocessor", "judge", "step"}));
  EXPECT_EQ(all.kinds()[1].summary, "Judges.");
  EXPECT_EQ(all.names("judge"), std::vector<std::string>{"strict"});
}

}  // namespace
}  // namespace croon

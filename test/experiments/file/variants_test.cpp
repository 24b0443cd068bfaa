#include "experiments/file/experiment_keys.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "test/experiments/support/fake_stages.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;
using Lines = std::vector<std::string>;

struct ReadVariants {
  std::vector<Variant> variants;
  Lines faults;

  Lines names() const {
    Lines names;
    for (const Variant& variant : variants) names.push_back(variant.name);
    return names;
  }
  /// The resolved pipeline of a variant.
  json pipeline(const std::string& name) const {
    for (const Variant& variant : variants) {
      if (variant.name == name) return pipeline_json(variant.pipeline);
    }
    return nullptr;
  }
};

/// Reads a pipeline of steps `first` (drift) and `behave` with the members `text` beside it.
ReadVariants read_variants(const std::string& text) {
  json root = json::parse("{" + text + "}");
  root["name"] = "x";
  root["dataset"] = {{"type", "fake"}};
  root["pipeline"] = json::parse(
      R"([{"step": "drift", "name": "first", "search": {"type": "coarse", "step_deg": 2}}, {"step": "behave"}])");
  std::vector<Fault> faults;
  ReadVariants read;
  const Catalogue catalogue = test::fake_catalogue();
  const params::Node node(root, "file", faults);
  const ExperimentKeys keys = experiment_table().read(node, {}, catalogue);
  read.variants = make_variants(keys, node, catalogue, faults);
  for (const Fault& fault : faults)
    read.faults.push_back(Fault{"", fault.where, fault.message}.line());
  return read;
}

TEST(Variants, ReplacesASlotWithoutMerging) {
  const ReadVariants all = read_variants(R"("variants": [
      {"name": "a", "replace": {"first.search": {"type": "coarse"}}},
      {"name": "b", "replace": {"first.search.step_deg": 3, "first.size_m": 1}}])");
  EXPECT_EQ(all.faults, Lines{});
  EXPECT_EQ(all.names(), (Lines{"base", "a", "b"}));
  EXPECT_EQ(all.pipeline("base")[0]["search"]["step_deg"], 2);
  EXPECT_EQ(all.pipeline("a")[0]["search"]["step_deg"], 5);
  EXPECT_EQ(all.pipeline("b")[0]["search"]["step_deg"], 3);
  EXPECT_EQ(all.pipeline("b")[0]["size_m"], 1);
  EXPECT_EQ(all.pipeline("b")[1], all.pipeline("base")[1]);
}

TEST(Variants, ReplaceAParameterByItsPresentOrFormerName) {
  const ReadVariants all = read_variants(R"("variants": [
      {"name": "a", "replace": {"first.extent_m": 3}},
      {"name": "b", "pipeline": [{"step": "drift", "name": "first", "extent_m": 1}],
       "replace": {"first.size_m": 2}},
      {"name": "c", "pipeline": [{"step": "drift", "name": "first", "size_m": 1}],
       "replace": {"first.extent_m": 2}}])");
  EXPECT_EQ(all.faults, Lines{});
  EXPECT_EQ(all.pipeline("a")[0]["size_m"], 3);
  EXPECT_EQ(all.pipeline("b")[0]["size_m"], 2);
  EXPECT_EQ(all.pipeline("c")[0]["size_m"], 2);
  Lines places;
  for (const Variant& variant : all.variants) {
    for (const Fault& note : variant.pipeline.front().notes) places.push_back(note.where);
  }
  EXPECT_EQ(places,
            (Lines{"/variants/0/replace/first.extent_m", "/variants/2/replace/first.extent_m"}));
  EXPECT_EQ(read_variants(R"("variants": [
                {"name": "a", "replace": {"first.extent_m": 3, "first.size_m": 2}}])")
                .faults,
            Lines{"/variants/0/replace/first.size_m: expected \"size_m\" without its former name, "
                  "found both"});
  EXPECT_EQ(read_variants(R"("grid": {"first.extent_m": [1, 2]})").names(),
            (Lines{"base/extent_m=1", "base/extent_m=2"}));
}

TEST(Variants, AStepThatTakesAPlaceTakesItsName) {
  const ReadVariants all = read_variants(R"("variants": [
      {"name": "a", "replace": {"first": {"step": "behave"}}},
      {"name": "b", "replace": {"first": {"step": "drift", "name": "other"}}},
      {"name": "c", "replace": {"first": {"step": "drift", "name": "behave"}}}])");
  EXPECT_EQ(all.faults, Lines{"/variants/2/replace/first: two steps are called \"behave\""});
  EXPECT_EQ(all.pipeline("a")[0]["name"], "first");
  EXPECT_EQ(all.pipeline("a")[0]["step"], "behave");
  EXPECT_EQ(all.pipeline("b")[0]["name"], "other");
  EXPECT_EQ(all.pipeline("b")[0]["search"]["step_deg"], 5);
}

TEST(Variants, Removes) {
  const ReadVariants all = read_variants(R"("variants": [{"name": "a", "remove": ["first"]}])");
  EXPECT_EQ(all.faults, Lines{});
  ASSERT_EQ(all.pipeline("a").size(), 1U);
  EXPECT_EQ(all.pipeline("a")[0]["name"], "behave");
}

TEST(Variants, ReplacesBelowADefault) {
  const ReadVariants all = read_variants(R"("variants": [
      {"name": "a", "replace": {"behave": {"step": "drift"}, "behave.search.step_deg": 7}}])");
  EXPECT_EQ(all.faults, Lines{});
  EXPECT_EQ(all.pipeline("a")[1]["search"]["step_deg"], 7);
}

TEST(Variants, FaultsStandWhereTheFileHasThem) {
  const ReadVariants all = read_variants(R"("variants": [
      {"name": "a", "replace": {"first.search": {"type": "coarse", "step_dg": 3}}},
      {"name": "b", "remove": ["frist", 4], "replace": {"first.serach": {}, "third.x": 1}},
      {"name": "c", "remove": ["first"], "replace": {"behave.how": "pas", "behave.how.much": 1}},
      {"name": "d", "replace": {"first.search.step_deg": 200, "first": {"step": "drift", "size_m": []}}},
      {"name": "e", "replace": {"first.": 1, "": 2, "behave": 3}},
      {"name": "base", "replaces": {}},
      {"name": "a/b"},
      {"remove": []}, 17])");
  // First the faults of the keys themselves, then those of what they do to the pipeline.
  EXPECT_EQ(
      all.faults,
      (Lines{
          "/variants/1/remove/1: expected a string, found 4",
          "/variants/5/replaces: unknown key \"replaces\"; did you mean \"replace\"?",
          "/variants/6/name: expected a name of letters, digits, spaces and _ . - + = ( ), not "
          "starting with a dot or a sign, found \"a/b\"",
          "/variants/7: the key \"name\" is missing", "/variants/8: expected an object, found 17",
          "/variants/1/remove/0: there is no step \"frist\"; did you mean \"first\"?",
          "/variants/1/replace/first.serach: step \"drift\" has no parameter \"serach\"; did you "
          "mean \"search\"?",
          "/variants/1/replace/third.x: there is no step \"third\"; known: first, behave",
          "/variants/2/replace/behave.how.much: \"how\" is not a stage: nothing below it can be "
          "replaced",
          "/variants/4/replace/: there is no step \"\"; known: first, behave",
          "/variants/4/replace/first.: step \"drift\" has no parameter \"\"; known: size_m, search",
          "/variants/5/name: two variants are called \"base\"",
          "/variants/0/replace/first.search/step_dg: unknown key \"step_dg\"; did you mean "
          "\"step_deg\"?",
          "/variants/2/replace/behave.how: expected one of pass, reject, defeat, memory, bug, nan, "
          "far, skewed, judge, misjudge, "
          "found \"pas\"; "
          "did you mean \"pass\"?",
          "/variants/3/replace/first/size_m: expected a number, found []",
          "/variants/3/replace/first.search.step_deg: expected a number from 0.1 to 90, found 200",
          "/variants/4/replace/behave: expected an object, found 3"}));
}

TEST(Variants, FaultsOfSeveralKeysStandWhereTheLastOfThemWasSet) {
  const std::string rule = "low_deg must not be above high_deg, found low_deg ";
  const ReadVariants all = read_variants(R"("variants": [
      {"name": "a", "replace": {"first.search": {"type": "between", "low_deg": 9, "high_deg": 8}}},
      {"name": "b", "replace": {"first.search": {"type": "between", "low_deg": 6, "high_deg": 8},
                                "first.search.high_deg": 5}},
      {"name": "c", "replace": {"first.search": {"type": "between"}, "first.search.low_deg": 20}},
      {"name": "d", "pipeline": [{"step": "drift", "name": "first",
                                  "search": {"type": "between", "low_deg": 30, "high_deg": 20}}]}])");
  EXPECT_EQ(all.faults,
            (Lines{"/variants/0/replace/first.search: " + rule + "9 and high_deg 8",
                   "/variants/1/replace/first.search.high_deg: " + rule + "6 and high_deg 5",
                   "/variants/2/replace/first.search.low_deg: the key \"high_deg\" is missing",
                   "/variants/3/pipeline/0/search: " + rule + "30 and high_deg 20"}));
}

TEST(Grid, FaultsOfSeveralKeysStandWhereTheLastOfThemWasSet) {
  const ReadVariants all = read_variants(R"("variants": [
      {"name": "a", "replace": {"first.search": {"type": "between", "low_deg": 6, "high_deg": 8}}}],
      "grid": {"first.search.high_deg": [5, 7]})");
  // The base pipeline's search has no such parameter.
  EXPECT_EQ(all.faults, (Lines{"/grid/first.search.high_deg/0: low_deg must not be above high_deg, "
                               "found low_deg 6 and high_deg 5"}));
}

TEST(Variants, EscapesPointers) {
  const ReadVariants all =
      read_variants(R"("variants": [{"name": "a", "replace": {"first.a/b~c": 1}}])");
  ASSERT_EQ(all.faults.size(), 1U);
  EXPECT_EQ(all.faults[0].rfind("/variants/0/replace/first.a~1b~0c: ", 0), 0U) << all.faults[0];
}

TEST(Grid, IsTheProductOfItsListsForEachVariant) {
  const ReadVariants all = read_variants(R"("variants": [{"name": "without", "remove": ["behave"]}],
      "grid": {"first.search": [{"type": "coarse"}, {"type": "fine"}], "behave.how": ["pass", "reject"]})");
  EXPECT_EQ(all.faults, Lines{});
  EXPECT_EQ(all.names(),
            (Lines{"base/how=pass/coarse", "base/how=pass/fine", "base/how=reject/coarse",
                   "base/how=reject/fine", "without/coarse", "without/fine"}));
  EXPECT_EQ(all.pipeline("base/how=reject/fine")[1]["how"], "reject");
  EXPECT_EQ(all.pipeline("base/how=reject/fine")[0]["search"]["type"], "fine");
}

TEST(Grid, LeavesOutAnAxisThatAPointOfAnotherLacks) {
  const ReadVariants all =
      read_variants(R"("grid": {"first.search": [{"type": "coarse"}, {"type": "fine"}],
                                            "first.search.step_deg": [1, 0.5]})");
  EXPECT_EQ(all.faults, Lines{});
  EXPECT_EQ(all.names(),
            (Lines{"base/coarse/step_deg=1", "base/coarse/step_deg=0.5", "base/fine"}));
}

TEST(Grid, AValueThatIsRefusedWhereOthersFitIsAFault) {
  const ReadVariants all = read_variants(R"("grid": {"behave": [
      {"step": "behave"}, {"step": "behave", "name": "first"}]})");
  ASSERT_EQ(all.faults.size(), 1U);
  EXPECT_EQ(all.faults[0].rfind("/grid/behave/1", 0), 0U) << all.faults[0];
  EXPECT_NE(all.faults[0].find("two steps are called"), std::string::npos) << all.faults[0];
}

TEST(Grid, TellsStagesOfATypeApart) {
  const ReadVariants all = read_variants(R"("grid": {"first.search": [
      {"type": "coarse"}, {"type": "coarse", "step_deg": 1}, {"type": "fine", "levels": 2}]})");
  EXPECT_EQ(all.faults, Lines{});
  EXPECT_EQ(all.names(), (Lines{"base/coarse", "base/coarse(step_deg=1)", "base/fine"}));
}

TEST(Grid, FaultsStandWhereTheFileHasThem) {
  const ReadVariants all = read_variants(R"("variants": [{"name": "v"}], "grid": {
      "first.size": [1], "second": [{"step": "drift"}], "first.size_m": [1, -1, 1.0], "behave.how": [],
      "first.search": 3})");
  // The base and the variant share their faults.
  EXPECT_EQ(
      std::set<std::string>(all.faults.begin(), all.faults.end()),
      (std::set<std::string>{
          "/grid/first.size: step \"drift\" has no parameter \"size\"; did you mean \"size_m\"?",
          "/grid/second: there is no step \"second\"; known: first, behave",
          "/grid/first.size_m/1: expected a number from 0 to 10, found -1",
          "/grid/first.size_m/2: \"size_m=1\" is in this list twice",
          "/grid/behave.how: expected a list of at least one value, found []",
          "/grid/first.search: expected a list, found 3"}));
}

TEST(Grid, RefusesToGrowBeyondReason) {
  json list = json::array();
  for (int i = 0; i < 200; ++i) list.push_back(0.01 * i);
  json degrees = json::array();
  for (int i = 1; i <= 60; ++i) degrees.push_back(i);
  const ReadVariants all = read_variants(R"("grid": {"first.size_m": )" + list.dump() +
                                         R"(, "first.search.step_deg": )" + degrees.dump() + "}");
  EXPECT_EQ(all.faults, (Lines{"/grid: expected at most 10000 variants, found more"}));
}

TEST(Variants, AreAtMostTenThousandWithoutAGridToo) {
  std::string list;
  for (int i = 0; i < 10000; ++i) list += ",{\"name\": \"v" + std::to_string(i) + "\"}";
  EXPECT_EQ(read_variants(R"("variants": [)" + list.substr(1) + "]").faults,
            (Lines{"/variants: expected at most 9999 variants beside the base, found 10000"}));
}

TEST(Variants, InsertStepsBesideOthers) {
  const ReadVariants all = read_variants(R"("variants": [
      {"name": "a", "insert": [{"after": "first", "step": {"step": "drift", "name": "second"}},
                               {"after": "second", "step": {"step": "drift", "name": "third"}},
                               {"before": "first", "step": {"step": "drift", "size_m": 3}}]},
      {"name": "b", "insert": [{"before": "behave", "step": {"step": "drift"}}],
       "remove": ["behave"], "replace": {"drift.size_m": 4}}])");
  EXPECT_EQ(all.faults, Lines{});
  const auto names = [&](const std::string& variant) {
    Lines steps;
    for (const json& step : all.pipeline(variant)) steps.push_back(step["name"]);
    return steps;
  };
  EXPECT_EQ(names("base"), (Lines{"first", "behave"}));
  EXPECT_EQ(names("a"), (Lines{"drift", "first", "second", "third", "behave"}));
  EXPECT_EQ(all.pipeline("a")[0]["size_m"], 3);
  EXPECT_EQ(names("b"), (Lines{"first", "drift"}));
  EXPECT_EQ(all.pipeline("b")[1]["size_m"], 4);
}

TEST(Variants, ShowFaultsOfInsertionsAtTheirPlaces) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {R"({"after": "frist", "step": {"step": "drift"}})",
       "/variants/0/insert/0/after: there is no step \"frist\"; did you mean \"first\"?"},
      {R"({"step": {"step": "drift"}})",
       R"(/variants/0/insert/0: expected one of "before" and "after", found {"step":{"step":"drift"}})"},
      {R"({"after": "first"})", "/variants/0/insert/0: the key \"step\" is missing"},
      {R"({"after": "first", "step": {"step": "behave"}})",
       "/variants/0/insert/0/after: two steps are called \"behave\": give the inserted one a "
       "\"name\""},
      {R"({"after": "first", "step": {"step": "drift", "size_m": "far"}})",
       "/variants/0/insert/0/step/size_m: expected a number, found \"far\""},
      {R"({"after": "first", "step": 3})",
       "/variants/0/insert/0/step: expected an object, found 3"}};
  for (const auto& [insertion, message] : cases) {
    const ReadVariants all =
        read_variants(R"("variants": [{"name": "a", "insert": [)" + insertion + "]}]");
    EXPECT_EQ(all.faults, Lines{message});
  }
}

TEST(Variants, MayHaveAWholePipeline) {
  const ReadVariants all = read_variants(R"("variants": [
      {"name": "other", "pipeline": [{"step": "drift", "size_m": 9}],
       "replace": {"drift.search": {"type": "coarse", "step_deg": 7}}}])");
  EXPECT_EQ(all.faults, Lines{});
  ASSERT_EQ(all.pipeline("other").size(), 1U);
  EXPECT_EQ(all.pipeline("other")[0]["size_m"], 9);
  EXPECT_EQ(all.pipeline("other")[0]["search"]["step_deg"], 7);
  EXPECT_EQ(read_variants(R"("variants": [{"name": "other", "pipeline": []}])").faults,
            Lines{"/variants/0/pipeline: expected a list of at least one step, found []"});
}

}  // namespace
}  // namespace croon::experiments

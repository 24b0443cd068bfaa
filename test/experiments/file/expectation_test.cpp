#include "experiments/file/expectation.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/file/experiment_loader.hpp"
#include "framework/base/error.hpp"
#include "test/experiments/support/fake_stages.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;
using Lines = std::vector<std::string>;

/// An expectation with every key.
json whole() {
  return json::parse(R"({"claim": "standard deviation of yaw, front", "source": "paper, Table 1",
                         "variant": "fine", "sensor": "front", "measure": "yaw",
                         "statistic": "std", "value": 0.0875, "band": [0, 0.0875],
                         "why": "scenes of our own"})");
}

json quoted() {
  return json::parse(R"({"method": "board", "source": "paper, Table 2", "statistic": "mean",
                         "pitch_deg": 1, "roll_deg": 2, "yaw_deg": 3, "x_m": 4, "y_m": 5,
                         "z_m": -6e-5})");
}

Experiment load(const json& expect, const json& others = json::array()) {
  json experiment = json::parse(R"({"name": "x", "dataset": {"type": "fake"},
                                    "pipeline": [{"step": "drift"}],
                                    "variants": [{"name": "fine"}]})");
  experiment["expect"] = expect;
  experiment["quoted"] = others;
  const test::TempFolder folder;
  return load_experiment(folder.write("x.json", experiment.dump()), test::fake_catalogue());
}

Lines faults_of(const json& expect, const json& others = json::array()) {
  Lines lines;
  try {
    load(expect, others);
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults()) {
      lines.push_back(Fault{"", fault.where, fault.message}.line());
    }
  }
  return lines;
}

/// The faults of one expectation in which `key` is `value`; a null takes the key out.
Lines faults_with(const std::string& key, const json& value) {
  json expectation = whole();
  if (value.is_null()) {
    expectation.erase(key);
  } else {
    expectation[key] = value;
  }
  return faults_of(json::array({expectation}));
}

TEST(Expectation, ReadsEveryKey) {
  const Claims claims = load(json::array({whole()}), json::array({quoted()})).claims;
  ASSERT_EQ(claims.expect.size(), 1U);
  const Expectation& expectation = claims.expect.front();
  EXPECT_EQ(expectation.claim, "standard deviation of yaw, front");
  EXPECT_EQ(expectation.source, "paper, Table 1");
  EXPECT_EQ(expectation.variant, "fine");
  EXPECT_EQ(expectation.sensor, "front");
  EXPECT_EQ(expectation.measure, "yaw");
  EXPECT_EQ(expectation.statistic, "std");
  EXPECT_EQ(expectation.value, 0.0875);
  EXPECT_EQ(expectation.band, (std::vector<double>{0.0, 0.0875}));
  EXPECT_EQ(expectation.why, "scenes of our own");
  ASSERT_EQ(claims.quoted.size(), 1U);
  const Quoted& row = claims.quoted.front();
  EXPECT_EQ(row.method + row.source + row.statistic, "boardpaper, Table 2mean");
  EXPECT_EQ(row.pitch_deg, 1.0);
  EXPECT_EQ(row.roll_deg, 2.0);
  EXPECT_EQ(row.yaw_deg, 3.0);
  EXPECT_EQ(row.x_m, 4.0);
  EXPECT_EQ(row.y_m, 5.0);
  EXPECT_EQ(row.z_m, -6e-5);
}

TEST(Expectation, MeansTheFirstVariantAndAllSensorsUnlessItSays) {
  json expectation = whole();
  for (const char* key : {"variant", "sensor", "why"}) expectation.erase(key);
  const Claims claims = load(json::array({expectation})).claims;
  EXPECT_EQ(claims.expect.front().variant, "base");
  EXPECT_EQ(claims.expect.front().sensor, "");
}

TEST(Expectation, OfAShareHasNoMeasure) {
  for (const char* statistic : {"success", "scenes"}) {
    json share = whole();
    share["statistic"] = statistic;
    EXPECT_EQ(faults_of(json::array({share})),
              Lines{std::string("/expect/0/measure: the statistic \"") + statistic +
                    "\" is a share and has no measure"});
    share.erase("measure");
    EXPECT_EQ(faults_of(json::array({share})), Lines{});
  }
}

TEST(Expectation, ShowsFaultsAtTheirPlaces) {
  EXPECT_EQ(faults_with("sede", 1),
            Lines{"/expect/0/sede: unknown key \"sede\"; known: claim, source, variant, sensor, "
                  "measure, statistic, value, band, why"});
  EXPECT_EQ(faults_with("variant", "fien"),
            Lines{"/expect/0/variant: there is no variant \"fien\"; did you mean \"fine\"?"});
  EXPECT_EQ(faults_with("measure", "yawn"),
            Lines{"/expect/0/measure: expected one of roll, pitch, yaw, x, y, z, rotation, "
                  "translation, found \"yawn\"; did you mean \"yaw\"?"});
  EXPECT_EQ(faults_with("statistic", "stdd"),
            Lines{"/expect/0/statistic: expected one of success, scenes, mean, std, median, rmse, "
                  "p95, within_scene_std, across_scenes_std, found \"stdd\"; did you mean "
                  "\"std\"?"});
  EXPECT_EQ(faults_with("measure", nullptr), Lines{"/expect/0: the key \"measure\" is missing"});
  EXPECT_EQ(faults_with("value", "0.1"),
            Lines{"/expect/0/value: expected a number, found \"0.1\""});
  for (const char* const text : {"[1,0]", "[1]", "[0,1,2]"}) {
    const json band = json::parse(text);
    EXPECT_EQ(
        faults_with("band", band),
        Lines{"/expect/0/band: expected [low, high] with low at most high, found " + band.dump()});
  }
  EXPECT_EQ(faults_of(json::array({1})), Lines{"/expect/0: expected an object, found 1"});
  EXPECT_EQ(faults_of(json::object()), Lines{"/expect: expected a list, found {}"});
}

TEST(Expectation, NamesEveryKeyThatIsMissing) {
  Lines expected;
  for (const char* key : {"claim", "source", "statistic", "value", "band"}) {
    expected.push_back(std::string("/expect/0: the key \"") + key + "\" is missing");
  }
  EXPECT_EQ(faults_of(json::array({json::object()})), expected);
  const json all = quoted();
  for (const auto& item : all.items()) {
    json row = quoted();
    row.erase(item.key());
    EXPECT_EQ(faults_of(json::array(), json::array({row})),
              Lines{"/quoted/0: the key \"" + item.key() + "\" is missing"});
  }
}

TEST(Expectation, SurvivesItsJsonToTheLastBit) {
  Rng rng = croon::test::test_rng();
  for (int i = 0; i < 100; ++i) {
    json expectation = whole();
    const double low = rng.uniform(-1.0, 1.0);
    expectation["value"] = rng.uniform(-1e-4, 1e-4);
    expectation["band"] = {low, low + rng.uniform()};
    expectation["claim"] = "a \"b\" \\ | µ " + std::to_string(i);
    if (rng.uniform() < 0.5) expectation.erase("sensor");
    if (rng.uniform() < 0.5) expectation.erase("why");
    const Claims claims = load(json::array({expectation, whole()}), json::array({quoted()})).claims;
    const std::string text = claims_json(claims);
    const Claims again = claims_of(text, "store");
    EXPECT_EQ(claims_json(again), text);
    ASSERT_EQ(again.expect.size(), 2U);
    EXPECT_EQ(again.expect[0].value, claims.expect[0].value);
    EXPECT_EQ(again.expect[0].band, claims.expect[0].band);
    EXPECT_EQ(again.expect[0].claim, claims.expect[0].claim);
    EXPECT_EQ(again.expect[0].sensor, claims.expect[0].sensor);
    EXPECT_EQ(again.expect[0].why, claims.expect[0].why);
    EXPECT_EQ(again.quoted[0].z_m, claims.quoted[0].z_m);
  }
}

TEST(Expectation, TextThatIsNoClaimsIsRefused) {
  for (const char* text : {"", "[]", "{\"expect\":[{}]}", "{\"expect\":"}) {
    EXPECT_THROW(claims_of(text, "store"), InputError) << text;
  }
  EXPECT_TRUE(claims_of(claims_json({}), "store").expect.empty());
}

}  // namespace
}  // namespace croon::experiments

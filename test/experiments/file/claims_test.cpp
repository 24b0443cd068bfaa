#include "experiments/file/claims.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/file/experiment.hpp"
#include "framework/base/error.hpp"
#include "test/experiments/support/fake_stages.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;
using Lines = std::vector<std::string>;

/// A claim with every key.
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

Experiment load_claims(const json& claims, const json& others = json::array()) {
  json experiment = json::parse(R"({"name": "x", "dataset": {"type": "fake"},
                                    "pipeline": [{"step": "drift"}],
                                    "variants": [{"name": "fine"}]})");
  experiment["claims"] = claims;
  experiment["quoted"] = others;
  const test::TempFolder folder;
  return load_experiment(folder.write("x.json", experiment.dump()), test::fake_catalogue());
}

Lines claim_faults(const json& claims, const json& others = json::array()) {
  Lines lines;
  try {
    load_claims(claims, others);
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults()) {
      lines.push_back(Fault{"", fault.where, fault.message}.line());
    }
  }
  return lines;
}

/// The faults of one claim in which `key` is `value`; a null takes the key out.
Lines faults_with(const std::string& key, const json& value) {
  json claim = whole();
  if (value.is_null()) {
    claim.erase(key);
  } else {
    claim[key] = value;
  }
  return claim_faults(json::array({claim}));
}

TEST(Claims, ReadsEveryKey) {
  const Experiment experiment = load_claims(json::array({whole()}), json::array({quoted()}));
  ASSERT_EQ(experiment.claims.size(), 1U);
  const Claim& claim = experiment.claims.front();
  EXPECT_EQ(claim.claim, "standard deviation of yaw, front");
  EXPECT_EQ(claim.source, "paper, Table 1");
  EXPECT_EQ(claim.variant, "fine");
  EXPECT_EQ(claim.sensor, "front");
  EXPECT_EQ(claim.measure, "yaw");
  EXPECT_EQ(claim.statistic, "std");
  EXPECT_EQ(claim.value, 0.0875);
  EXPECT_EQ(claim.band, (std::array<double, 2>{0.0, 0.0875}));
  EXPECT_EQ(claim.why, "scenes of our own");
  ASSERT_EQ(experiment.quoted.size(), 1U);
  const Quoted& row = experiment.quoted.front();
  EXPECT_EQ(row.method + row.source + row.statistic, "boardpaper, Table 2mean");
  EXPECT_EQ(row.pitch_deg, 1.0);
  EXPECT_EQ(row.roll_deg, 2.0);
  EXPECT_EQ(row.yaw_deg, 3.0);
  EXPECT_EQ(row.x_m, 4.0);
  EXPECT_EQ(row.y_m, 5.0);
  EXPECT_EQ(row.z_m, -6e-5);
}

TEST(Claims, MeansTheFirstVariantAndAllSensorsUnlessItSays) {
  json claim = whole();
  for (const char* key : {"variant", "sensor", "why"}) claim.erase(key);
  const std::vector<Claim> claims = load_claims(json::array({claim})).claims;
  EXPECT_EQ(claims.front().variant, "base");
  EXPECT_EQ(claims.front().sensor, "");
}

TEST(Claims, OfAShareHasNoMeasure) {
  for (const char* statistic : {"success", "agreement", "scenes"}) {
    json share = whole();
    share["statistic"] = statistic;
    EXPECT_EQ(claim_faults(json::array({share})),
              Lines{"/claims/0/measure: expected no measure of a share of the trials, found "
                    "\"measure\""});
    share.erase("measure");
    EXPECT_EQ(claim_faults(json::array({share})), Lines{});
  }
}

TEST(Claims, ShowsFaultsAtTheirPlaces) {
  EXPECT_EQ(faults_with("sede", 1),
            Lines{"/claims/0/sede: unknown key \"sede\"; known: claim, source, variant, sensor, "
                  "measure, statistic, over, value, band, why, measures, values, band_rule"});
  EXPECT_EQ(faults_with("variant", "fien"),
            Lines{"/claims/0/variant: there is no variant \"fien\"; did you mean \"fine\"?"});
  EXPECT_EQ(faults_with("measure", "yawn"),
            Lines{"/claims/0/measure: expected one of roll, pitch, yaw, x, y, z, rotation, "
                  "translation, found \"yawn\"; did you mean \"yaw\"?"});
  EXPECT_EQ(
      faults_with("statistic", "stdd"),
      Lines{"/claims/0/statistic: expected one of success, agreement, scenes, mean, std, median, "
            "rmse, p95, within_scene_std, across_scenes_std, found \"stdd\"; did you mean "
            "\"std\"?"});
  EXPECT_EQ(faults_with("measure", nullptr), Lines{"/claims/0: the key \"measure\" is missing"});
  EXPECT_EQ(faults_with("value", "0.1"),
            Lines{"/claims/0/value: expected a number, found \"0.1\""});
  for (const char* const text : {"[1,0]", "[1]", "[0,1,2]"}) {
    const json band = json::parse(text);
    EXPECT_EQ(
        faults_with("band", band),
        Lines{"/claims/0/band: expected [low, high] with low at most high, found " + band.dump()});
  }
  EXPECT_EQ(claim_faults(json::array({1})), Lines{"/claims/0: expected an object, found 1"});
  EXPECT_EQ(claim_faults(json::object()), Lines{"/claims: expected a list, found {}"});
}

TEST(Claims, AreNotReadIfTheyAreTooMany) {
  EXPECT_EQ(claim_faults(json::array_t(10001, json::object())),
            (Lines{"/claims: expected at most 10000 claims, found 10001"}));
}

TEST(Claims, NamesEveryKeyThatIsMissing) {
  Lines expected;
  for (const char* key : {"claim", "source", "statistic", "value", "band"}) {
    expected.push_back(std::string("/claims/0: the key \"") + key + "\" is missing");
  }
  EXPECT_EQ(claim_faults(json::array({json::object()})), expected);
  const json all = quoted();
  for (const auto& item : all.items()) {
    json row = quoted();
    row.erase(item.key());
    EXPECT_EQ(claim_faults(json::array(), json::array({row})),
              Lines{"/quoted/0: the key \"" + item.key() + "\" is missing"});
  }
}

TEST(Claims, SurviveCanonicalJsonToTheLastBit) {
  Rng rng = croon::test::test_rng();
  for (int i = 0; i < 100; ++i) {
    json claim = whole();
    const double low = rng.uniform(-1.0, 1.0);
    claim["value"] = rng.uniform(-1e-4, 1e-4);
    claim["band"] = {low, low + rng.uniform()};
    claim["claim"] = "a \"b\" \\ | µ " + std::to_string(i);
    if (rng.uniform() < 0.5) claim.erase("sensor");
    if (rng.uniform() < 0.5) claim.erase("why");
    const Experiment read = load_claims(json::array({claim, whole()}), json::array({quoted()}));
    const std::string text = claims_json(read.claims);
    const Experiment again = read_experiment_json(experiment_json(read), "store");
    EXPECT_EQ(claims_json(again.claims), text);
    ASSERT_EQ(again.claims.size(), 2U);
    EXPECT_EQ(again.claims[0].value, read.claims[0].value);
    EXPECT_EQ(again.claims[0].band, read.claims[0].band);
    EXPECT_EQ(again.claims[0].claim, read.claims[0].claim);
    EXPECT_EQ(again.claims[0].sensor, read.claims[0].sensor);
    EXPECT_EQ(again.claims[0].why, read.claims[0].why);
    EXPECT_EQ(again.quoted[0].z_m, read.quoted[0].z_m);
  }
}

/// Part of the paper's Table 1.
json table() {
  return json::parse(R"({"claim": "error", "source": "paper, Table 1", "why": "scenes of our own",
                         "measures": ["pitch", "x"],
                         "band_rule": {"rule": "no_worse", "samples": 1798},
                         "values": {"front": {"mean": [-0.0111, 0.0028], "std": [0.0407, 0.0363]},
                                    "all": {"std": [0.03, 0.04]}}})");
}

json table_with(const char* pointer, const json& value) {
  json changed = table();
  changed[json::json_pointer(pointer)] = value;
  return changed;
}

TEST(Claims, ATableIsAClaimForEachSensorMeasureAndStatistic) {
  const std::vector<Claim> claims = load_claims(json::array({whole(), table()})).claims;
  ASSERT_EQ(claims.size(), 7U);
  // Sensors in alphabetical order.
  EXPECT_EQ(claims[1].claim, "error, all sensors: std of pitch");
  EXPECT_EQ(claims[1].sensor, "");
  EXPECT_EQ(claims[2].claim, "error, all sensors: std of x");
  const Claim& mean = claims[3];
  EXPECT_EQ(mean.claim, "error, front: mean of pitch");
  EXPECT_EQ(mean.source + ", " + mean.why, "paper, Table 1, scenes of our own");
  EXPECT_EQ(mean.variant + "," + mean.sensor + "," + mean.measure + "," + mean.statistic,
            "base,front,pitch,mean");
  EXPECT_EQ(mean.value, -0.0111);
  // 0.0111 + 2 x 0.0407 / sqrt(1798) = 0.01302, rounded up.
  EXPECT_EQ(mean.band, (std::array<double, 2>{-0.0131, 0.0131}));
  EXPECT_EQ(claims[4].statistic, "std");
  EXPECT_EQ(claims[4].band, (std::array<double, 2>{0.0, 0.0407}));
  EXPECT_EQ(claims[5].measure, "x");
  EXPECT_EQ(claims[5].band, (std::array<double, 2>{-0.0046, 0.0046}));
}

TEST(Claims, BandsMayLieAroundZero) {
  json means = table();
  means["band_rule"] = {{"rule", "around_zero"}, {"half_width", {0.02, 0.5}}};
  for (const Claim& claim : load_claims(json::array({means})).claims) {
    const double half_width = claim.measure == "pitch" ? 0.02 : 0.5;
    EXPECT_EQ(claim.band, (std::array<double, 2>{-half_width, half_width}));
  }
}

TEST(Claims, ATableShowsFaultsAtTheirPlaces) {
  const std::vector<std::pair<json, std::string>> cases = {
      {table_with("/values/front/std", json::array({1})),
       "/claims/0/values/front/std: expected one number for each of the 2 measures, found [1]"},
      {table_with("/values/all/std", {0.03, -0.04}),
       "/claims/0/values/all/std: expected numbers of at least 0, found -0.04"},
      {table_with("/values/front/stdd", {1, 2}),
       "/claims/0/values/front/stdd: unknown key \"stdd\"; did you mean \"std\"?"},
      {table_with("/measures", {"pitch", "yawn"}),
       "/claims/0/measures/1: expected one of roll, pitch, yaw, x, y, z, rotation, translation, "
       "found \"yawn\"; did you mean \"yaw\"?"},
      {table_with("/sensor", "left"),
       "/claims/0/sensor: expected no key of a single claim beside \"values\", found \"sensor\""},
      {table_with("/band_rule/rule", "around_zero"),
       "/claims/0/band_rule: the key \"half_width\" is missing"},
      {table_with("/variant", "fien"),
       "/claims/0/variant: there is no variant \"fien\"; did you mean \"fine\"?"}};
  for (const auto& [claims, message] : cases) {
    const Lines faults = claim_faults(json::array({claims}));
    ASSERT_FALSE(faults.empty()) << message;
    EXPECT_EQ(faults.front(), message);
  }
  json alone = table();
  alone["values"]["front"].erase("std");
  const Lines faults = claim_faults(json::array({alone}));
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults.front().substr(0, 55),
            "/claims/0/values/front/mean: expected a mean with \"std\"");
}

TEST(Claims, JsonThatIsNoExperimentIsRefused) {
  for (const char* text : {"null", "[]", R"({"claims":[{}]})", "{}"}) {
    EXPECT_THROW(read_experiment_json(json::parse(text), "store"), InputError) << text;
  }
}

}  // namespace
}  // namespace croon::experiments

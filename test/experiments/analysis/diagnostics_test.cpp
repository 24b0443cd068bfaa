#include "experiments/analysis/diagnostics.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "experiments/analysis/results.hpp"
#include "experiments/report/result_tables.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<TrialRecord> records() {
  std::vector<TrialRecord> records;
  for (const char* variant : {"base", "other"}) {
    for (const int trial : {0, 1, 2}) {
      TrialRecord& record = records.emplace_back();
      record.id = {variant, "scene", "left", trial};
      record.status = Status::finished;
      record.T_reference_sensor.emplace();
      const double value = trial == 2 ? kInfinity : 1.0 + trial;
      record.steps = {{"find", 0.0, {{"rmse_m", value}, {"pairs", 10.0 * trial}}, {}},
                      {"idle", 0.0, {}, {}}};
      if (record.id.variant == "other")
        record.steps = {{"find", 0.0, {{"rmse_m", std::nan("")}}, {}}};
    }
  }
  return records;
}

StoreHeader header_of_steps() {
  StoreHeader header;
  header.provenance = {{"starts", "{}"}};
  header.versions = {{"framework", 1}};
  header.manifest = "{}";
  header.trials = 3;
  header.variants = {{"base", "[]"}, {"other", "[1]"}};
  header.scenes = {{"scene", ""}};
  header.sensors = {{"left", "top"}};
  return header;
}

/// What the store of `records`, added in this order, has.
StoredRun stored(const std::vector<TrialRecord>& records) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.path() / "store.sqlite";
  {
    Store store(path, header_of_steps());
    for (const TrialRecord& record : records) store.add({&record});
  }
  EXPECT_TRUE(read_store(path).steps.numbers.empty());
  return read_store(path, Content::trials_and_steps);
}

TEST(Diagnostics, AreInTheOrderOfReportsWhateverThatOfTheStore) {
  std::vector<TrialRecord> reversed = records();
  const StoredRun run = stored(reversed);
  std::reverse(reversed.begin(), reversed.end());
  const StoredRun other = stored(reversed);
  const std::string csv = diagnostics_csv(run.records, run.steps);
  EXPECT_EQ(diagnostics_csv(other.records, other.steps), csv);
  EXPECT_EQ(csv,
            "variant,scene,sensor,trial,step,name,value\n"
            "base,scene,left,0,find,rmse_m,1\nbase,scene,left,0,find,pairs,0\n"
            "base,scene,left,1,find,rmse_m,2\nbase,scene,left,1,find,pairs,10\n"
            "base,scene,left,2,find,rmse_m,inf\nbase,scene,left,2,find,pairs,20\n"
            "other,scene,left,0,find,rmse_m,nan\nother,scene,left,1,find,rmse_m,nan\n"
            "other,scene,left,2,find,rmse_m,nan\n");
}

TEST(Diagnostics, MediansAreOfTheFiniteValues) {
  const StoredRun run = stored(records());
  const std::vector<DiagnosticSummary> found = summarise_diagnostics(run.records, run.steps);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].variant + found[0].step + found[0].name, "basefindrmse_m");
  EXPECT_EQ(found[0].trials, 3);
  EXPECT_EQ(found[0].median, 1.5);
  EXPECT_EQ(found[1].name, "pairs");
  EXPECT_EQ(found[1].median, 10.0);
  EXPECT_EQ(found[2].variant, "other");
  EXPECT_EQ(found[2].trials, 3);
  EXPECT_EQ(found[2].median, std::nullopt);
  const auto json = nlohmann::json::parse(summary_json({}, {}, found))["diagnostics"];
  EXPECT_EQ(json[0]["median"], 1.5);
  EXPECT_TRUE(json[2]["median"].is_null());
}

TEST(Diagnostics, OfACraftedStoreAreRefused) {
  for (const char* craft : {"UPDATE steps SET step = '=1+1'", "UPDATE steps SET figures = '[1]]'",
                            R"(UPDATE steps SET figures = '{"a": "b"}')",
                            R"(UPDATE steps SET figures = '{"a\u001b": 1}')"}) {
    const test::TempFolder folder;
    const std::filesystem::path path = folder.path() / "store.sqlite";
    {
      Store store(path, header_of_steps());
      for (const TrialRecord& record : records()) store.add({&record});
    }
    Database(path, Access::write).run(craft);
    EXPECT_THROW(read_store(path, Content::trials_and_steps), InputError) << craft;
  }
}

}  // namespace
}  // namespace croon::experiments

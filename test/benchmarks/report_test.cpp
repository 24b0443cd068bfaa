#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "benchmarks/report/page.hpp"
#include "benchmarks/report/summary.hpp"
#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/picture/writers.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::benchmarks {
namespace {

using nlohmann::json;

json line(const std::string& name, double time, const std::string& unit = "ms") {
  return {{"run_name", name + "/real_time"},
          {"real_time", time},
          {"time_unit", unit},
          {"source_points", 1000.0}};
}

json file_of(const json& lines) {
  return {{"context",
           {{"date", "2026-11-23"},
            {"executable", "some/bin/bench_volume_scorers"},
            {"num_cpus", 2},
            {"library_build_type", "release"},
            {"load_avg", {0.1, 0.2, 0.3}},
            {"caches", {{{"type", "Data"}, {"level", 1}, {"size", 32768}}}},
            {"commit", "abc"}}},
          {"benchmarks", lines}};
}

BenchmarkRun read(const json& file) {
  const test::TempFolder folder;
  write_whole_file(folder.path() / "run.json", file.dump());
  return read_run(folder.path() / "run.json");
}

TEST(BenchmarkReport, ReadsWhatIsMeasuredOfWhat) {
  const BenchmarkRun run =
      read(file_of({line("pose/carla/004069/front/leaf_size_m:0.05/brick_hash", 200.0, "us"),
                    line("query/street_1000/near", 1.0)}));
  ASSERT_EQ(run.measurements.size(), 1U);
  const Measurement& one = run.measurements.front();
  EXPECT_EQ(one.question, "pose");
  EXPECT_EQ(one.clouds, "carla/004069/front");
  EXPECT_EQ(one.leaf_size_m, 0.05);
  EXPECT_EQ(one.scorer, "brick_hash");
  EXPECT_DOUBLE_EQ(one.time_ms, 0.2);
  EXPECT_EQ(one.source_points, 1000.0);
  EXPECT_FALSE(one.spread);
  EXPECT_EQ(run.program, "bench_volume_scorers");
  ASSERT_EQ(run.times.size(), 1U);
  EXPECT_EQ(run.times[0].subject, "query/street_1000");
  EXPECT_EQ(run.times[0].way, "near");
  EXPECT_EQ(run.times[0].time, 1.0);
  EXPECT_EQ(run.times[0].unit, "ms");
  EXPECT_EQ(run.machine.caches, std::vector<std::string>({"L1 32 KiB"}));
}

TEST(BenchmarkReport, TakesTheMedianOfRepetitions) {
  const std::string name = "batch/street_1000/leaf_size_m:0.1/brick_hash";
  json median = line(name, 64.0), mean = line(name, 99.0), spread = line(name, 0.03);
  median["aggregate_name"] = "median";
  median["poses"] = 64.0;
  mean["aggregate_name"] = "mean";
  spread["aggregate_name"] = "cv";
  const BenchmarkRun run = read(file_of({mean, median, spread}));
  ASSERT_EQ(run.measurements.size(), 1U);
  EXPECT_EQ(run.measurements[0].time_ms, 1.0);
  EXPECT_EQ(run.measurements[0].spread, 0.03);
}

TEST(BenchmarkReport, RefusesWhatIsNoRun) {
  EXPECT_THROW(read(json::array()), InputError);
  EXPECT_THROW(read(file_of(json::array({{{"name", "x"}}}))), InputError);
  json failed = line("pose/street_1000/leaf_size_m:0.1/brick_hash", 1.0);
  failed["error_occurred"] = true;
  failed["error_message"] = "no ground";
  try {
    read(file_of(json::array({failed})));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(error.faults().at(0).line().find("no ground"), std::string::npos);
  }
}

TEST(BenchmarkReport, HasATableForSubjectsWithTheSameWays) {
  const Page page =
      page_of({read(file_of({line("a/build/ours", 1.5), line("a/build/peer", 3.0),
                             line("a/near/ours", 250.0, "ns"), line("a/near/peer", 500.0, "ns"),
                             line("scan/front", 7.0), line("alone", 9.0)}))},
              "2026-11-23");
  EXPECT_NE(page.markdown.find("|  | unit | `ours` | `peer` |\n|---|---:|---:|---:|\n"
                               "| a/build | ms | 1.50 | 3.00 |\n| a/near | ns | 250 | 500 |\n\n"),
            std::string::npos)
      << page.markdown;
  EXPECT_NE(page.markdown.find("|  | unit | `front` |\n|---|---:|---:|\n| scan | ms | 7.00 |\n"),
            std::string::npos);
  EXPECT_NE(page.markdown.find("|  | ms | 9.00 |"), std::string::npos);
}

TEST(BenchmarkReport, HasWhatABoundScorerKeepsInMemory) {
  json lines = json::array();
  for (const auto& [scorer, mib] : {std::pair("brick_hash", 2.0), {"morton_sort", 0.5}}) {
    lines.push_back(line(std::string("bind/street_1000/leaf_size_m:0.05/") + scorer, 1.0));
    lines.back()["memory_bytes"] = mib * 1024 * 1024;
  }
  const Page page = page_of({read(file_of(lines))}, "2026-11-23");
  EXPECT_NE(page.markdown.find("### Memory"), std::string::npos);
  EXPECT_NE(page.markdown.find("| street_1000, 0.05 m | 2.00 | **0.500** |"), std::string::npos)
      << page.markdown;
}

TEST(BenchmarkReport, HasWhatLimitsAPosePerPoint) {
  json lines = json::array();
  const std::string clouds = "/street_1000/leaf_size_m:0.05/";
  for (const auto& [name, time_ms] : {std::pair("floor" + clouds + "reading", 0.001),
                                      {"floor" + clouds + "keys", 0.002},
                                      {"pose" + clouds + "brick_hash", 0.01}}) {
    lines.push_back(line(name, time_ms));
    lines.back()["source_points"] = 1000;
  }
  const Page page = page_of({read(file_of(lines))}, "2026-11-23");
  EXPECT_NE(page.markdown.find("| street_1000, 0.05 m | 1000 | 1.00 | 2.00 | 10.0 | 5.00 |"),
            std::string::npos)
      << page.markdown;
}

TEST(BenchmarkReport, HasTheFastestBoldAndAPictureOverPoints) {
  json lines = json::array();
  for (const int count : {1000, 10000}) {
    for (const auto& [scorer, time] : {std::pair("brick_hash", 1.0), {"peer_slow", 30.0}}) {
      const std::string name =
          "pose/street_" + std::to_string(count) + "/leaf_size_m:0.05/" + scorer;
      lines.push_back(line(name, time * count));
      lines.back()["source_points"] = count;
    }
  }
  const Page page = page_of({read(file_of(lines))}, "2026-11-23");
  EXPECT_NE(page.markdown.find("| street_1000, 0.05 m | **1000** | 30000 |"), std::string::npos)
      << page.markdown;
  EXPECT_NE(page.markdown.find("| street_1000, 0.05 m | 1.00 | 30.0 |"), std::string::npos);
  ASSERT_EQ(page.pictures.size(), 1U);
  EXPECT_NE(page.markdown.find(page.pictures[0].name), std::string::npos);
  const std::string svg = svg_bytes(page.pictures[0].drawing);
  EXPECT_NE(svg.find("peer_slow"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(BenchmarkReport, HasCountersAlsoWhereGoogleBenchmarkWritesNan) {
  const std::string name = "calibration/street_1000/croon_best";
  json median = line(name, 5.0), mean = line(name, 9.0), spread = line(name, 0.03);
  median["aggregate_name"] = "median";
  median["rotation_deg"] = 0.25;
  median["wrong_ratio"] = 0.0;
  mean["aggregate_name"] = "mean";
  mean["rotation_deg"] = 7.0;
  mean["wrong_ratio"] = 0.2;
  spread["aggregate_name"] = "cv";
  spread["wrong_ratio"] = 987654;
  std::string text = file_of({mean, median, spread}).dump();
  text.replace(text.find("987654"), 6, " -NaN");
  const test::TempFolder folder;
  write_whole_file(folder.path() / "run.json", text);
  const BenchmarkRun run = read_run(folder.path() / "run.json");
  ASSERT_EQ(run.times.size(), 1U);
  EXPECT_EQ(run.times[0].counters.at("rotation_deg"), 0.25);
  EXPECT_EQ(run.times[0].counters.at("wrong_ratio"), 0.2);
}

TEST(BenchmarkSummary, ComparesAPeerWithWhatRunsOnAsManyCores) {
  const std::string text =
      summary_of({read(file_of({line("normals/street_1000/croon_one_core", 10.0),
                                line("normals/street_1000/croon", 5.0),
                                line("normals/street_1000/peer_slow_one_core", 30.0),
                                line("nearest_off/street_1000/croon", 200.0, "ns"),
                                line("nearest_off/street_1000/peer_fast", 100.0, "ns"),
                                line("alone/street_1000/croon", 1.0)}))},
                 "notebook/tables.md");
  EXPECT_NE(text.find("faster in 1 of 2 comparisons"), std::string::npos) << text;
  EXPECT_NE(text.find("slower in: nearest_off of street_1000 (`fast`, 0.500 ×)"), std::string::npos)
      << text;
  EXPECT_NE(text.find("| normals | street_1000 | 10.0 ms on one core | `slow` 30.0 ms on one core "
                      "(3.00 ×) |"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("alone"), std::string::npos);
  EXPECT_NE(text.find("(notebook/tables.md)"), std::string::npos);
}

TEST(BenchmarkSummary, ShowsWhereAFastAnswerIsWrong) {
  json best = line("calibration/street_1000/croon_best", 500.0);
  json peer = line("calibration/street_1000/peer_fgr", 100.0);
  best["rotation_deg"] = 0.01;
  best["translation_m"] = 0.002;
  peer["rotation_deg"] = 90.0;
  peer["translation_m"] = 3.0;
  peer["wrong_ratio"] = 0.5;
  const BenchmarkRun run = read(file_of({best, peer}));
  const std::string text = summary_of({run}, "notebook/tables.md");
  EXPECT_NE(
      text.find("| street_1000 | 500 ms, 0.0100°, 2.00 mm | 100 ms (0.200 ×), 90.0°, 3000 mm, "
                "**50 % wrong** |"),
      std::string::npos)
      << text;
  EXPECT_EQ(page_of({run}, "2026-11-23").markdown.find("street_1000"), std::string::npos);
}

TEST(BenchmarkSummary, HasTheProgramAndTheCostPerPoint) {
  json street = line("growth/street_1000/best", 2.0);
  json program = line("program/five/with_report", 1500.0);
  street["points"] = 2000.0;
  program["points"] = 650000.0;
  program["peak_bytes"] = 100.0 * 1024 * 1024;
  program["max_rotation_deg"] = 0.1;
  program["max_translation_m"] = 0.01;
  const std::string text = summary_of({read(file_of({street, program}))}, "notebook/tables.md");
  EXPECT_NE(text.find("| per point | 1.00 µs |"), std::string::npos) << text;
  EXPECT_NE(text.find("| five | 650000 | with report | 1.50 s, 0.100°, 10.0 mm | 100 MiB |"),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace croon::benchmarks

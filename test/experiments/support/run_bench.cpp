#include "test/experiments/support/run_bench.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "test/experiments/support/fake_stages.hpp"

namespace croon::test {

namespace fs = std::filesystem;
using experiments::RunOptions;
using nlohmann::json;

json drifting() {
  return json::parse(R"({"name": "x", "dataset": {"type": "fake"}, "starts": {"trials": 6},
                         "pipeline": [{"step": "drift"}, {"step": "behave"}],
                         "variants": [{"name": "far", "replace": {"drift.size_m": 2}}]})");
}

json agreeing() {
  json experiment = drifting();
  experiment["starts"].update({{"rotation_deg", 0.1}, {"translation_m", 0.01}});
  experiment["pipeline"][0]["size_m"] = 0.01;
  experiment["variants"][0]["replace"]["drift.size_m"] = 0.02;
  return experiment;
}

Bench::Bench() : Bench(drifting()) {}

Bench::Bench(const json& experiment) : experiment_(folder_.write("x.json", experiment.dump())) {}

RunOptions Bench::options(const std::string& out) const {
  RunOptions options;
  options.experiment = experiment_;
  options.out = folder_.path() / out;
  options.quiet = true;
  return options;
}

int Bench::run(const RunOptions& options) const {
  std::ostringstream out, progress;
  return experiments::run_command(options, fake_catalogue(), out, progress);
}

std::string Bench::fault(const RunOptions& options) const {
  try {
    run(options);
    return "";
  } catch (const InputError& error) {
    return error.faults().front().line();
  }
}

std::map<std::string, std::string> Bench::bytes(const std::string& out) const {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_.path() / out)) {
    if (!entry.is_regular_file() || entry.path().stem() == "timings") continue;
    std::string text = read_whole_file(entry.path());
    if (entry.path().filename() == "manifest.json") {
      json manifest = json::parse(text);
      EXPECT_EQ(manifest.erase("host"), 1U);
      text = manifest.dump();
    }
    files[fs::relative(entry.path(), folder_.path() / out).string()] = text;
  }
  return files;
}

}  // namespace croon::test

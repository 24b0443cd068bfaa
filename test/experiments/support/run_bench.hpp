#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "experiments/cli/commands.hpp"
#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "test/experiments/support/fake_stages.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::test {

/// Trials whose poses are all over the place.
inline nlohmann::json drifting() {
  return nlohmann::json::parse(
      R"({"name": "x", "dataset": {"type": "fake"}, "starts": {"trials": 6},
                         "pipeline": [{"step": "drift"}, {"step": "behave"}],
                         "variants": [{"name": "far", "replace": {"drift.size_m": 2}}]})");
}

/// The same, but the trials of a variant agree on their pose.
inline nlohmann::json agreeing() {
  nlohmann::json experiment = drifting();
  experiment["starts"].update({{"rotation_deg", 0.1}, {"translation_m", 0.01}});
  experiment["pipeline"][0]["size_m"] = 0.01;
  experiment["variants"][0]["replace"]["drift.size_m"] = 0.02;
  return experiment;
}

/// An experiment in a folder, and runs of it.
class Bench {
 public:
  explicit Bench(const nlohmann::json& experiment = drifting())
      : experiment_(folder_.write("x.json", experiment.dump())) {}

  experiments::RunOptions options(const std::string& out) const {
    experiments::RunOptions options;
    options.experiment = experiment_;
    options.out = folder_.path() / out;
    options.quiet = true;
    return options;
  }

  int run(const experiments::RunOptions& options) const {
    std::ostringstream out, progress;
    return experiments::run_command(options, fake_catalogue(), out, progress);
  }

  /// The first line of the InputError that the run ends with.
  std::string fault(const experiments::RunOptions& options) const {
    try {
      run(options);
      return "";
    } catch (const InputError& error) {
      return error.faults().front().line();
    }
  }

  const TempFolder& folder() const { return folder_; }
  const std::filesystem::path& experiment() const { return experiment_; }

  /// The bytes of every file but timings.csv, and of the manifest without its host.
  std::map<std::string, std::string> bytes(const std::string& out) const {
    std::map<std::string, std::string> files;
    for (const std::filesystem::directory_entry& entry :
         std::filesystem::recursive_directory_iterator(folder_.path() / out)) {
      if (!entry.is_regular_file() || entry.path().filename() == "timings.csv") continue;
      std::string text = read_whole_file(entry.path());
      if (entry.path().filename() == "manifest.json") {
        nlohmann::json manifest = nlohmann::json::parse(text);
        EXPECT_EQ(manifest.erase("host"), 1U);
        text = manifest.dump();
      }
      files[std::filesystem::relative(entry.path(), folder_.path() / out).string()] = text;
    }
    return files;
  }

 private:
  TempFolder folder_;
  std::filesystem::path experiment_;
};

}  // namespace croon::test

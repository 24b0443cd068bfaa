#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "experiments/cli/commands.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::test {

/// Trials whose poses are all over the place.
nlohmann::json drifting();

/// The same, but the trials of a variant agree on their pose.
nlohmann::json agreeing();

/// An experiment in a folder, and runs of it.
class Bench {
 public:
  Bench();  ///< Of `drifting`.
  explicit Bench(const nlohmann::json& experiment);

  experiments::RunOptions options(const std::string& out) const;
  int run(const experiments::RunOptions& options) const;
  /// The first line of the InputError that the run ends with.
  std::string fault(const experiments::RunOptions& options) const;

  const TempFolder& folder() const { return folder_; }
  const std::filesystem::path& experiment() const { return experiment_; }

  /// The bytes of every file but wall times, and of the manifest without its host.
  std::map<std::string, std::string> bytes(const std::string& out) const;

 private:
  TempFolder folder_;
  std::filesystem::path experiment_;
};

}  // namespace croon::test

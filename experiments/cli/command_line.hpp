#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/cli/describe_command.hpp"
#include "experiments/cli/export_command.hpp"
#include "experiments/cli/merge_command.hpp"
#include "experiments/cli/run_command.hpp"
#include "experiments/cli/simulate_command.hpp"
#include "experiments/cli/starts_command.hpp"

namespace CLI {
class App;
}

namespace croon::experiments {

/// What the command line asks for.
struct CommandLine {
  RunOptions run;
  MergeOptions merge;
  ExportOptions to_export;
  SimulateOptions simulate;
  DescribeOptions describe;
  StartsOptions starts;
  std::vector<std::filesystem::path> to_validate;
  std::vector<std::filesystem::path> with_claims;
  std::string stages;
  bool as_json = false;
  bool as_markdown = false;
};

/// Adds the commands, whose words go to `line`, to the program.
void add_commands(CLI::App& app, CommandLine& line);

}  // namespace croon::experiments

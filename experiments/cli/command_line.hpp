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

namespace croon::experiments {

/// What the command line asks for.
struct CommandLine {
  std::string command;  ///< "run"; empty where `text` is all there is to say.
  std::string text;     ///< Help or version.
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

/// Reads the words that the program is called with. Throws InputError where they are wrong.
CommandLine read_command_line(int argc, char** argv);

}  // namespace croon::experiments

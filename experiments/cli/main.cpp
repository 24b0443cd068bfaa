#include <unistd.h>

#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

#include "experiments/cli/claims_command.hpp"
#include "experiments/cli/command_line.hpp"
#include "experiments/cli/fault_lines.hpp"
#include "experiments/cli/validate_command.hpp"
#include "experiments/file/experiment.hpp"
#include "registry/help.hpp"
#include "registry/registry.hpp"

namespace croon::experiments {
namespace {

constexpr int kRequestIsWrong = 2;

int run_chosen(const CommandLine& line) {
  if (line.command == "run") {
    RunOptions options = line.run;
    options.colours = ::isatty(STDOUT_FILENO) != 0;
    return run_command(options, registry(), std::cout, std::cerr);
  }
  if (line.command == "merge") {
    MergeOptions options = line.merge;
    options.colours = ::isatty(STDOUT_FILENO) != 0;
    return merge_command(options, std::cout);
  }
  if (line.command == "simulate") {
    return simulate_command(line.simulate, registry(), std::cout, std::cerr);
  }
  if (line.command == "describe") {
    return describe_command(line.describe, registry(), std::cout);
  }
  if (line.command == "export") return export_command(line.to_export, std::cout);
  if (line.command == "claims") return claims_command(line.with_claims, std::cout);
  if (line.command == "validate") {
    return validate_command(line.to_validate, registry(), std::cout, std::cerr);
  }
  if (line.command == "starts") {
    starts_command(line.starts, registry(), std::cout);
  } else if (line.command == "schema") {
    std::cout << experiment_schema(registry());
  } else if (line.command == "stages") {
    const HelpFormat plain = line.as_json ? HelpFormat::json : HelpFormat::text;
    std::cout << stages_help(registry(), line.stages,
                             line.as_markdown ? HelpFormat::markdown : plain);
  } else {
    std::cout << line.text;
  }
  return 0;
}

/// Output that did not get through, to a full disc or a pipe that is gone, is no success.
int run_and_flush(const CommandLine& line) {
  const int code = run_chosen(line);
  if (!std::cout.flush()) throw InputError("", "standard output", "cannot be written");
  return code;
}

int croon_main(int argc, char** argv) {
  try {
    return run_and_flush(read_command_line(argc, argv));
  } catch (const InputError& error) {
    print_faults(error, std::cerr);
  } catch (const std::filesystem::filesystem_error& error) {
    std::cerr << "croon: " << error.path1().string() << ": " << error.code().message() << "\n";
  }
  return kRequestIsWrong;
}

}  // namespace
}  // namespace croon::experiments

int main(int argc, char** argv) {
  try {
    return croon::experiments::croon_main(argc, argv);
  } catch (const std::bad_alloc&) {
    std::cerr << "croon: there is not enough memory; what was finished is in the store\n";
    return 1;
  } catch (const std::exception& error) {
    std::cerr << "croon: this is a bug: " << error.what() << "\n";
    return 1;
  }
}

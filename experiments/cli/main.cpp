#include <unistd.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

#include "experiments/cli/claims_command.hpp"
#include "experiments/cli/command_line.hpp"
#include "experiments/cli/fault_lines.hpp"
#include "experiments/cli/validate_command.hpp"
#include "experiments/engine/version.hpp"
#include "framework/base/nearest_name.hpp"
#include "registry/help.hpp"
#include "registry/registry.hpp"
#include "registry/schema.hpp"

namespace croon::experiments {
namespace {

constexpr int kRequestIsWrong = 2;

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// Throws InputError for the words that no option or command took.
void refuse_leftovers(const CLI::App& app) {
  const std::vector<CLI::App*> commands = app.get_subcommands();
  const CLI::App& command = commands.empty() ? app : *commands.front();
  for (const std::string& word : app.remaining(true)) {
    if (word.compare(0, 1, "-") == 0) {
      throw InputError("", "",
                       "unknown option \"" + word + "\"" + name_hint(word, option_names(command)));
    }
    if (!commands.empty()) throw InputError("", "", "unexpected \"" + word + "\"");
    std::vector<std::string> names;
    for (const CLI::App* known : app.get_subcommands({})) names.push_back(known->get_name());
    throw InputError("", "", "unknown command \"" + word + "\"" + name_hint(word, names));
  }
}

int run_chosen(const CLI::App& app, const CommandLine& line) {
  refuse_leftovers(app);
  if (app.got_subcommand("run")) {
    RunOptions options = line.run;
    options.colours = ::isatty(STDOUT_FILENO) != 0;
    return run_command(options, registry(), std::cout, std::cerr);
  }
  if (app.got_subcommand("merge")) {
    MergeOptions options = line.merge;
    options.colours = ::isatty(STDOUT_FILENO) != 0;
    return merge_command(options, std::cout);
  }
  if (app.got_subcommand("simulate")) {
    return simulate_command(line.simulate, registry(), std::cout, std::cerr);
  }
  if (app.got_subcommand("describe")) {
    return describe_command(line.describe, registry(), std::cout);
  }
  if (app.got_subcommand("export")) return export_command(line.to_export, std::cout);
  if (app.got_subcommand("claims")) return claims_command(line.with_claims, std::cout);
  if (app.got_subcommand("validate")) {
    return validate_command(line.to_validate, registry(), std::cout, std::cerr);
  }
  if (app.got_subcommand("starts")) {
    starts_command(line.starts, registry(), std::cout);
  } else if (app.got_subcommand("schema")) {
    std::cout << experiment_schema(registry());
  } else if (app.got_subcommand("stages")) {
    const HelpFormat plain = line.as_json ? HelpFormat::json : HelpFormat::text;
    std::cout << stages_help(registry(), line.stages,
                             line.as_markdown ? HelpFormat::markdown : plain);
  } else {
    std::cout << app.help();
  }
  return 0;
}

/// Output that did not get through, to a full disc or a pipe that is gone, is no success.
int run_and_flush(const CLI::App& app, const CommandLine& line) {
  const int code = run_chosen(app, line);
  if (!std::cout.flush()) throw InputError("", "standard output", "cannot be written");
  return code;
}

int croon_main(int argc, char** argv) {
  CLI::App app("A bench for target-less multi-LiDAR calibration.", "croon");
  CommandLine line;
  app.set_version_flag("--version", std::string("croon ") + croon_version());
  app.allow_extras();
  add_commands(app, line);
  try {
    app.parse(argc, argv);
    return run_and_flush(app, line);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    std::cerr << "croon: " << error.what() << "\n";
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

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

#include "experiments/cli/claims_command.hpp"
#include "experiments/cli/describe_command.hpp"
#include "experiments/cli/export_command.hpp"
#include "experiments/cli/fault_lines.hpp"
#include "experiments/cli/merge_command.hpp"
#include "experiments/cli/run_command.hpp"
#include "experiments/cli/simulate_command.hpp"
#include "experiments/cli/starts_command.hpp"
#include "experiments/cli/validate_command.hpp"
#include "experiments/engine/version.hpp"
#include "framework/base/nearest_name.hpp"
#include "registry/help.hpp"
#include "registry/registry.hpp"
#include "registry/schema.hpp"

namespace croon::experiments {
namespace {

constexpr int kRequestIsWrong = 2;

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

void add_run(CLI::App& app, RunOptions& options) {
  CLI::App* run = app.add_subcommand("run", "Run an experiment, or what of it is missing.");
  run->add_option("EXPERIMENT", options.experiment, "The experiment, a JSON file.")->required();
  run->add_option("--out", options.out, "Folder to write to; default results/<name>.");
  run->add_option("--data", options.data, "The data root; default $CROON_DATA, else data.");
  run->add_option("--jobs", options.jobs, "Threads; default all cores.")
      ->check(CLI::Range(1, 4096));
  run->add_option("--trials", options.trials, "Starts per variant, scene and sensor.")
      ->check(CLI::Range(1, 1000000000));
  run->add_option("--only", options.only, "Run these variants alone.");
  run->add_option("--shard", options.shard, "Run part K of N of the trials, K/N.");
  run->add_flag("--plan", options.plan, "Tell what there is to run, and how much variants share.");
  run->add_flag("--no-share", options.no_share, "Run the variants one by one, to compare.");
  run->add_flag("--fresh", options.fresh, "Delete what is in the folder and start over.");
  run->add_flag("--quiet", options.quiet, "Do not show progress.");
  run->add_flag("--clouds", options.clouds, "Write the rig's clouds, fused by the estimates.");
  run->add_flag("--png", options.png, "Draw the first scene from above, before and after.");
}

void add_merge(CLI::App& app, MergeOptions& options) {
  CLI::App* merge = app.add_subcommand("merge", "Put the results of shards together.");
  merge->add_option("DIR", options.folders, "Folders of results.")->required();
  merge->add_option("--out", options.out, "Folder to write to.")->required();
}

void add_simulate(CLI::App& app, SimulateOptions& options) {
  CLI::App* simulate =
      app.add_subcommand("simulate", "Write the simulated scenes of an experiment as a dataset.");
  simulate->add_option("EXPERIMENT", options.experiment, "The experiment, a JSON file.")
      ->required();
  simulate->add_option("--out", options.out, "Folder to write the dataset to.")->required();
  simulate->add_option("--jobs", options.jobs, "Threads; default all cores.")
      ->check(CLI::Range(1, 4096));
  simulate->add_flag("--png", options.png, "Draw each scene, from behind the car and from above.");
  simulate->add_flag("--quiet", options.quiet, "Do not show progress.");
}

void add_describe(CLI::App& app, DescribeOptions& options) {
  CLI::App* describe =
      app.add_subcommand("describe", "Tell what the clouds of experiments' datasets look like.");
  describe->add_option("EXPERIMENT", options.experiments, "Experiments, JSON files.")->required();
  describe->add_option("--data", options.data, "The data root; default $CROON_DATA, else data.");
  describe->add_option("--out", options.out, "Folder for clouds.csv and ranges.svg.");
  describe->add_option("--scenes", options.scenes, "Look at so many scenes of each dataset.")
      ->check(CLI::Range(1, 1000000));
  describe->add_option("--jobs", options.jobs, "Threads; default all cores.")
      ->check(CLI::Range(1, 4096));
}

void add_export(CLI::App& app, ExportOptions& options) {
  CLI::App* exporting = app.add_subcommand("export", "Write results as a table for a paper.");
  exporting->add_option("DIR", options.folder, "A folder of results.")->required();
  exporting->add_option("--format", options.format, "csv, md (the default), latex or json.");
  exporting->add_option("--out", options.out, "The file to write; default the output.");
}

void add_starts(CLI::App& app, StartsOptions& options) {
  CLI::App* starts = app.add_subcommand("starts", "Write the list of an experiment's starts.");
  starts->add_option("EXPERIMENT", options.experiment, "The experiment, a JSON file.")->required();
  starts->add_option("--out", options.out, "File to write; default standard output.");
  starts->add_option("--data", options.data, "The data root; default $CROON_DATA, else data.");
  starts->add_option("--trials", options.trials, "Starts per scene and sensor.")
      ->check(CLI::Range(1, 1000000000));
}

void add_others(CLI::App& app, CommandLine& line) {
  CLI::App* validate =
      app.add_subcommand("validate", "Check experiment files; the data need not be there.");
  validate->add_option("PATH", line.to_validate, "Files, or folders of *.json.")->required();
  CLI::App* claims =
      app.add_subcommand("claims", "Hold results against what their experiments expect.");
  claims->add_option("DIR", line.with_claims, "Folders of results.")->required();
  CLI::App* stages = app.add_subcommand("stages", "Tell what stages there are.");
  stages->add_option("KIND/NAME", line.stages,
                     "A kind of stage, or one stage with its parameters.");
  CLI::Option* json = stages->add_flag("--json", line.as_json, "As JSON.");
  stages->add_flag("--markdown", line.as_markdown, "As Markdown.")->excludes(json);
  app.add_subcommand("schema", "Print the JSON Schema of experiment files.");
}

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
  if (!std::cout.flush()) throw InputError("", "standard output", "cannot be written");
  return 0;
}

int croon_main(int argc, char** argv) {
  CLI::App app("A bench for target-less multi-LiDAR calibration.", "croon");
  CommandLine line;
  app.set_version_flag("--version", std::string("croon ") + croon_version());
  app.allow_extras();
  add_run(app, line.run);
  add_merge(app, line.merge);
  add_export(app, line.to_export);
  add_simulate(app, line.simulate);
  add_describe(app, line.describe);
  add_starts(app, line.starts);
  add_others(app, line);
  try {
    app.parse(argc, argv);
    return run_chosen(app, line);
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

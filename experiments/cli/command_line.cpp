#include "experiments/cli/command_line.hpp"

#include <CLI/CLI.hpp>
#include <sstream>

#include "experiments/store/version.hpp"
#include "framework/base/error.hpp"

namespace croon::experiments {
namespace {

void add_run(CLI::App& app, RunOptions& options) {
  CLI::App* run = app.add_subcommand("run", "Run an experiment, or what of it is missing.");
  run->add_option("EXPERIMENT", options.experiment, "The experiment, a JSON file.")->required();
  run->add_option("--out", options.out, "Folder to write to; default results/<name>.");
  run->add_option("--data", options.data, "The data root; default $CROON_DATA, else data.");
  run->add_option("--jobs", options.jobs, "Threads; default all cores.")
      ->check(CLI::Range(1, 4096));
  run->add_option("--trials", options.trials, "Starts per variant, scene and sensor.")
      ->check(CLI::Range(1, 1000000000).description(""));
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
      ->check(CLI::Range(1, 1000000000).description(""));
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

}  // namespace

CommandLine read_command_line(int argc, char** argv) {
  CLI::App app("A bench for target-less multi-LiDAR calibration.", "croon");
  app.set_version_flag("--version", std::string("croon ") + croon_version());
  app.allow_extras();
  CommandLine line;
  add_run(app, line.run);
  add_merge(app, line.merge);
  add_export(app, line.to_export);
  add_simulate(app, line.simulate);
  add_describe(app, line.describe);
  add_starts(app, line.starts);
  add_others(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    std::ostringstream text;
    app.exit(success, text, text);
    line.text = text.str();
    return line;
  } catch (const CLI::ParseError& error) {
    throw InputError("", "", error.what());
  }
  refuse_leftovers(app);
  const std::vector<CLI::App*> commands = app.get_subcommands();
  if (commands.empty()) {
    line.text = app.help();
  } else {
    line.command = commands.front()->get_name();
  }
  return line;
}

}  // namespace croon::experiments

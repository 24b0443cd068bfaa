// The program: reads the command line, which only this file does, and runs the command.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <csignal>
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <new>
#include <optional>
#include <stdexcept>

#include "experiments/cli/calibrate_command.hpp"
#include "experiments/cli/check_command.hpp"
#include "experiments/cli/commands.hpp"
#include "experiments/file/start_rule.hpp"
#include "experiments/report/export.hpp"
#include "experiments/report/figures.hpp"
#include "experiments/store/version.hpp"
#include "framework/base/error.hpp"
#include "framework/base/huge_pages.hpp"
#include "framework/base/memory.hpp"
#include "framework/base/text.hpp"
#include "framework/base/threads.hpp"
#include "framework/calibration/extrinsics.hpp"
#include "framework/picture/writers.hpp"
#include "registry/help.hpp"
#include "registry/registry.hpp"

namespace croon::experiments {
namespace {

constexpr int kRequestIsWrong = 2;

/// Runs a command and returns its exit code.
using Action = std::function<int()>;

/// The commands with their options, and what each of them does.
class Program {
 public:
  Program() : app_("A bench for target-less multi-LiDAR calibration.", "croon") {
    app_.set_version_flag("--version", std::string("croon ") + croon_version());
    app_.allow_extras();
    add_calibrate();
    add_check();
    add_run();
    add_merge();
    add_export();
    add_simulate();
    add_describe();
    add_starts();
    add_validate_and_claims();
    add_stages_and_schema();
  }

  /// Throws InputError if the words are wrong.
  int run(int argc, char** argv) {
    try {
      app_.parse(argc, argv);
    } catch (const CLI::Success& success) {
      return app_.exit(success, std::cout, std::cout);
    } catch (const CLI::RequiredError& error) {
      throw InputError("", "", error.what() + long_list());
    } catch (const CLI::ParseError& error) {
      throw InputError("", "", error.what());
    }
    refuse_leftovers();
    const std::vector<CLI::App*> commands = app_.get_subcommands();
    if (!commands.empty()) return actions_.at(commands.front())();
    std::cout << app_.help();
    return 0;
  }

 private:
  CLI::App& add(const std::string& name, const std::string& sentence, Action action) {
    CLI::App* command = app_.add_subcommand(name, sentence);
    actions_[command] = std::move(action);
    return *command;
  }

  /// Why `text` is not what the option `name` expects; empty if it is. An empty text is refused: a
  /// variable of a script that is not set must not stand for the default. So is the next option,
  /// which such a variable without quotes leaves for a value.
  static std::string why_no_text(const std::string& name, const std::string& text,
                                 const std::string& what) {
    if (text.empty()) return "expected " + what + ", found \"\"";
    if (name.compare(0, 2, "--") != 0 || text.compare(0, 2, "--") != 0) return "";
    return "expected " + what + ", found the option \"" + text + "\"";
  }

  /// Adds an option for text, or for a list of them.
  template <class T>
  static CLI::Option* add_text(CLI::App& command, const std::string& name, T& option,
                               const std::string& sentence, const std::string& what) {
    return command.add_option(name, option, sentence)->check([name, what](const std::string& text) {
      return why_no_text(name, text, what);
    });
  }

  /// `option` is a path, or a list of them.
  template <class T>
  static CLI::Option* add_path(CLI::App& command, const std::string& name, T& option,
                               const std::string& sentence) {
    return add_text(command, name, option, sentence, "a path");
  }

  template <class Options>
  static void add_experiment(CLI::App& command, Options& options) {
    add_path(command, "EXPERIMENT", options.experiment, "The experiment, a JSON file.")->required();
    add_path(command, "--with", options.with,
             "A workload, whose keys replace those of the experiment: dataset, starts, ...; "
             "may be repeated.")
        ->type_name("WORKLOAD");
  }

  static void add_data(CLI::App& command, std::filesystem::path& option) {
    add_path(command, "--data", option, "The data root; default $CROON_DATA, else data.");
  }

  static void add_jobs(CLI::App& command, int& option) {
    command.add_option("--jobs", option, "Threads; default all cores.")
        ->check(CLI::Range(1, kMaxJobs));
  }

  static void add_trials(CLI::App& command, int& option, const std::string& sentence) {
    command.add_option("--trials", option, sentence)->check([](const std::string& text) {
      int trials = 0;
      const char* const end = text.data() + text.size();
      const auto read = std::from_chars(text.data(), end, trials);
      const bool is_whole = read.ec == std::errc() && read.ptr == end;
      if (is_whole && trials >= 1 && trials <= kMaxTrials) return std::string();
      return "expected a whole number from 1 to " + std::to_string(kMaxTrials) + ", found " + text;
    });
  }

  void add_calibrate() {
    CalibrateOptions& o = calibrate_;
    CLI::App& calibrate =
        add("calibrate", "Calibrate a vehicle's LiDARs to each other, from recordings.", [this] {
          calibrate_.colours = ::isatty(STDOUT_FILENO) != 0;
          return calibrate_command(calibrate_, registry(), std::cout, std::cerr);
        });
    add_path(calibrate, "INPUT", o.inputs,
             "A file or folder of clouds per sensor, PATH or NAME=PATH; a recording (.mcap, .db3) "
             "and its topics; or a rig.json.")
        ->required();
    add_path(calibrate, "--nominal", o.nominal,
             "Poses to compare with, and to try near if a sensor is rejected.");
    calibrate.add_flag("--from-scratch", o.from_scratch, "Only compare with the nominal poses.");
    add_text(calibrate, "--base", o.base,
             "The reference's pose in the vehicle frame: x,y,z,roll,pitch,yaw in m and degrees, or "
             "a file of extrinsics; then files are written for base_link too.",
             "a pose or a path");
    add_path(calibrate, "--out", o.out, "Folder to write to; default results/calibration.");
    add_text(calibrate, "--format", o.formats,
             "Further formats of extrinsics, separated by commas: " + extrinsics_formats() + ".",
             "a format")
        ->delimiter(',');
    calibrate.add_flag("--with-rejected", o.with_rejected, "Write rejected poses too, marked.");
    calibrate.add_flag("--clouds", o.clouds, "Write the clouds in the reference's frame.");
    calibrate.add_flag("--no-pictures", o.no_pictures, "Do not draw.");
    add_rig_options(calibrate, o);
  }

  void add_check() {
    CalibrateOptions& o = check_;
    CLI::App& check = add("check", "Check given extrinsics: right, wrong or undecidable.", [this] {
      check_.colours = ::isatty(STDOUT_FILENO) != 0;
      return check_command(check_, registry(), std::cout, std::cerr);
    });
    add_path(check, "EXTRINSICS", o.nominal, "The poses, in any format that --nominal accepts.")
        ->required();
    add_path(check, "INPUT", o.inputs, "Clouds, as of calibrate.")->required();
    add_rig_options(check, o);
  }

  /// The options of the commands that calibrate.
  static void add_rig_options(CLI::App& command, CalibrateOptions& o) {
    add_text(command, "--reference", o.reference, "The sensor whose frame it is; default first.",
             "a sensor");
    add_number(command, "--max-time-gap", o.max_time_gap_s, 0.0, 3600.0,
               "Clouds of one scene are at most this far apart, s; default 0.05.");
    add_number(command, "--max-scenes", o.max_scenes, 1, 1000,
               "Of more scenes, use this many, evenly spaced; default 10.");
    add_text(command, "--pipeline", o.pipeline, "best (default), driving, paper, or a file.",
             "a pipeline");
    add_number(command, "--seed", o.seed, std::uint64_t{0}, std::uint64_t{1} << 53U,
               "Names the random numbers; default 1.");
    command.add_flag("--quiet", o.quiet, "Do not show progress.");
    add_jobs(command, o.jobs);
  }

  /// "ros2, urdf, ...".
  static std::string extrinsics_formats() {
    std::string names;
    for (const std::string& name : extrinsics_format_names()) {
      names += (names.empty() ? "" : ", ") + name;
    }
    return names;
  }

  template <class Number>
  static void add_number(CLI::App& command, const std::string& name, std::optional<Number>& option,
                         Number min, Number max, const std::string& sentence) {
    command.add_option(name, option, sentence)->check(CLI::Range(min, max));
  }

  void add_run() {
    CLI::App& run = add("run", "Run an experiment, or what of it is missing.", [this] {
      run_.colours = ::isatty(STDOUT_FILENO) != 0;
      return run_command(run_, registry(), std::cout, std::cerr);
    });
    add_experiment(run, run_);
    add_path(run, "--out", run_.out, "Folder to write to; default results/<name>.");
    add_data(run, run_.data);
    add_jobs(run, run_.jobs);
    add_trials(run, run_.trials, "Starts per variant, scene and sensor.");
    add_text(run, "--only", run_.only, "Run these variants alone.", "a variant");
    add_text(run, "--shard", run_.shard, "Run part K of N of the trials, K/N.",
             "K/N with 1 <= K <= N");
    run.add_flag("--plan", run_.plan, "Show what there is to run, and how much variants share.");
    run.add_flag("--no-share", run_.no_share, "Run the variants one by one, to compare.");
    run.add_flag("--fresh", run_.fresh, "Delete what is in the folder and start over.");
    run.add_flag("--same-build", run_.same_build,
                 "Refuse to go on with trials of another build of croon.");
    run.add_flag("--quiet", run_.quiet, "Do not show progress.");
    run.add_flag("--clouds", run_.clouds,
                 "Write the rig's clouds, fused by the poses that trials agree on.");
    run.add_flag("--png", run_.png, "Draw the first scene from above, before and after.");
  }

  void add_merge() {
    CLI::App& merge = add("merge", "Put the results of shards together.", [this] {
      merge_.colours = ::isatty(STDOUT_FILENO) != 0;
      return merge_command(merge_, std::cout);
    });
    add_path(merge, "DIR", merge_.folders, "Folders of results.")->required();
    add_path(merge, "--out", merge_.out, "Folder to write to.")->required();
    merge.add_flag("--same-build", merge_.same_build, "Refuse trials of different builds.");
  }

  void add_export() {
    CLI::App& exporting = add("export", "Write results as a table or a figure for a paper.",
                              [this] { return export_command(export_, std::cout); });
    add_path(exporting, "DIR", export_.folders, "Folders of results, for one table.")->required();
    add_text(exporting, "--format", export_.format,
             names_of(export_formats()) +
                 "; default md. With --figure: " + names_of(drawing_formats()) + "; default pdf.",
             "a format");
    add_path(exporting, "--out", export_.out, "The file to write; default the output.");
    add_text(exporting, "--figure", export_.figure, "A figure: " + names_of(figures()) + ".",
             "a figure");
    add_width(exporting, export_.width);
    add_text(exporting, "--units", export_.units, "Of lengths: m, mm.", "m or mm");
    add_text(exporting, "--variants", export_.variants, "Only these variants.", "a variant");
    add_text(exporting, "--sensors", export_.sensors,
             "Only these sensors; all: all together, a row of a table.", "a sensor");
    add_text(exporting, "--kinds", export_.kinds, "Only scenes of these kinds.", "a kind of scene");
    add_text(exporting, "--columns", export_.columns,
             "Columns of a table: success, rotation_median, x, x_p95, ...", "a column");
    exporting.add_flag("--compact", export_.compact, "A table of a row per variant, for a page.");
    exporting.add_flag("--title", export_.title, "A figure with its title.");
  }

  /// "csv, json".
  template <class Row>
  static std::string names_of(const std::vector<Row>& rows) {
    std::string names;
    for (const Row& row : rows) names += (names.empty() ? "" : ", ") + std::string(row.name);
    return names;
  }

  static void add_width(CLI::App& command, std::string& option) {
    add_text(command, "--width", option, names_of(named_sheets()) + ".", "a width");
  }

  void add_simulate() {
    CLI::App& simulate =
        add("simulate", "Write the simulated scenes of an experiment as a dataset.",
            [this] { return simulate_command(simulate_, registry(), std::cout, std::cerr); });
    add_experiment(simulate, simulate_);
    add_path(simulate, "--out", simulate_.out, "Folder to write the dataset to.")->required();
    add_jobs(simulate, simulate_.jobs);
    simulate.add_flag("--png", simulate_.png,
                      "Draw each scene, from behind the car and from above.");
    simulate.add_flag("--quiet", simulate_.quiet, "Do not show progress.");
  }

  void add_describe() {
    CLI::App& describe = add("describe", "Describe the clouds of experiments' datasets.",
                             [this] { return describe_command(describe_, registry(), std::cout); });
    add_path(describe, "EXPERIMENT", describe_.experiments, "Experiments, JSON files.")->required();
    add_data(describe, describe_.data);
    add_path(describe, "--out", describe_.out, "Folder for clouds.csv and ranges.svg.");
    add_text(describe, "--format", describe_.format,
             "Of the figure of ranges: " + names_of(drawing_formats()) + "; default svg.",
             "a format");
    add_width(describe, describe_.width);
    describe.add_option("--scenes", describe_.scenes, "Look at so many scenes of each dataset.")
        ->check(CLI::Range(1, 1000000));
    add_jobs(describe, describe_.jobs);
  }

  void add_starts() {
    CLI::App& starts = add("starts", "Write the list of an experiment's starts.",
                           [this] { return starts_command(starts_, registry(), std::cout); });
    add_experiment(starts, starts_);
    add_path(starts, "--out", starts_.out, "File to write; default standard output.");
    add_data(starts, starts_.data);
    add_trials(starts, starts_.trials, "Starts per scene and sensor.");
  }

  void add_validate_and_claims() {
    CLI::App& validate =
        add("validate", "Check experiment files; the data need not be there.",
            [this] { return validate_command(paths_, registry(), std::cout, std::cerr); });
    add_path(validate, "PATH", paths_, "Files, or folders of *.json.")->required();
    CLI::App& claims = add("claims", "Hold results against the claims of their experiments.",
                           [this] { return claims_command(paths_, std::cout); });
    add_path(claims, "DIR", paths_, "Folders of results.")->required();
  }

  void add_stages_and_schema() {
    CLI::App& stages = add("stages", "List the stages.", [this] {
      std::cout << stages_help(registry(), stages_,
                               as_markdown_ ? HelpFormat::markdown
                               : as_json_   ? HelpFormat::json
                                            : HelpFormat::text);
      return 0;
    });
    add_text(stages, "KIND/NAME", stages_, "A kind of stage, or one stage with its parameters.",
             "a kind of stage");
    CLI::Option* json = stages.add_flag("--json", as_json_, "As JSON.");
    stages.add_flag("--markdown", as_markdown_, "As Markdown.")->excludes(json);
    add("schema", "Print the JSON Schema of experiment files.", [] {
      std::cout << experiment_schema(registry());
      return 0;
    });
  }

  /// Throws InputError for words that no option or command took.
  void refuse_leftovers() const {
    const std::vector<CLI::App*> commands = app_.get_subcommands();
    const CLI::App& command = commands.empty() ? app_ : *commands.front();
    for (const std::string& word : app_.remaining(true)) {
      if (word.compare(0, 1, "-") == 0) refuse_option(word.substr(0, word.find('=')), command);
      if (!commands.empty()) throw InputError("", "", "unexpected \"" + word + "\"");
      std::vector<std::string> names;
      for (const CLI::App* known : app_.get_subcommands({})) names.push_back(known->get_name());
      throw InputError("", "", "unknown command \"" + word + "\"" + name_hint(word, names));
    }
  }

  [[noreturn]] static void refuse_option(const std::string& name, const CLI::App& command) {
    const std::vector<std::string> known = options_of(command);
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InputError("", "", "unknown option \"" + name + "\"" + name_hint(name, known));
    }
    throw InputError("", "",
                     "expected the option \"" + name + "\" behind the command, found it before \"" +
                         command.get_name() + "\"");
  }

  /// Says of an option that took several words that it did: what is missing may be among them.
  std::string long_list() const {
    for (const CLI::App* command : app_.get_subcommands()) {
      for (const CLI::Option* option : command->get_options()) {
        if (option->get_positional() || option->count() < 2) continue;
        return "; " + option->get_name() + " took \"" + option->results().back() +
               "\": what is required comes before " + option->get_name();
      }
    }
    return "";
  }

  static std::vector<std::string> options_of(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
  }

  CLI::App app_;
  std::map<const CLI::App*, Action> actions_;
  CalibrateOptions calibrate_, check_;
  RunOptions run_;
  MergeOptions merge_;
  ExportOptions export_;
  SimulateOptions simulate_;
  DescribeOptions describe_;
  StartsOptions starts_;
  std::vector<std::filesystem::path> paths_;
  std::string stages_;
  bool as_json_ = false;
  bool as_markdown_ = false;
};

/// Output that was not written, to a full disk or a closed pipe, is an error.
int run_and_flush(int argc, char** argv) {
  const int code = Program().run(argc, argv);
  if (!std::cout.flush()) throw InputError("", "standard output", "cannot be written");
  return code;
}

int croon_main(int argc, char** argv) {
  try {
    return run_and_flush(argc, argv);
  } catch (const InputError& error) {
    print_faults(error, std::cerr);
  } catch (const std::filesystem::filesystem_error& error) {
    print_faults(InputError(error.path1().string(), "", error.code().message()), std::cerr);
  }
  return kRequestIsWrong;
}

}  // namespace
}  // namespace croon::experiments

int main(int argc, char** argv) {
  // A file that grows beyond the limit of the shell is then an error like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  // With less, the memory allocator crashes when it starts a thread.
  constexpr double kMinAddressSpace_bytes = 128e6;
  if (croon::address_space_bytes() < kMinAddressSpace_bytes) {
    std::cerr << "croon: needs at least 128 MB of address space; see ulimit -v\n";
    return 1;
  }
  try {
    return croon::experiments::croon_main(argc, argv);
  } catch (const std::bad_alloc&) {
    std::cerr << "croon: there is not enough memory; what was finished is in the store\n";
    return 1;
  } catch (const std::runtime_error& error) {
    // Of the machine, which has no memory or threads left: of the standard library and of TBB.
    std::cerr << "croon: " << croon::printable(error.what())
              << "; what was finished is in the store\n";
    return 1;
  } catch (const std::exception& error) {
    std::cerr << "croon: this is a bug: " << croon::printable(error.what()) << "\n";
    return 1;
  }
}

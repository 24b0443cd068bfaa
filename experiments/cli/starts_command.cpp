#include "experiments/cli/commands.hpp"

#include <memory>

#include "experiments/cli/command.hpp"
#include "experiments/cli/options.hpp"
#include "experiments/file/experiment.hpp"
#include "experiments/run/starts.hpp"
#include "experiments/session/output_files.hpp"
#include "framework/base/memory.hpp"
#include "framework/base/text.hpp"
#include "framework/stage/given_motions.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {
namespace {

/// A row of the file; see kStartHeader.
struct StartRow {
  std::string scene;
  std::string sensor;
  int trial;
  Start start;
};

Columns<StartRow> start_columns() {
  Columns<StartRow> columns;
  columns.add({"scene"}, &StartRow::scene)
      .add({"sensor"}, &StartRow::sensor)
      .add({"trial"}, &StartRow::trial);
  for (const int i : {0, 1, 2}) {
    columns.add({std::string("t") + "xyz"[i], "m"},
                [i](const StartRow& row) { return row.start.translation(i); });
  }
  for (const int i : {0, 1, 2, 3}) {
    columns.add({std::string("q") + "xyzw"[i]},
                [i](const StartRow& row) { return row.start.rotation.coeffs()(i); });
  }
  return columns;
}

/// Throws InputError, with an estimate, if the list of starts does not fit into memory.
void check_list_size(const Experiment& experiment, const std::vector<SceneGroup>& groups) {
  // A row, and its text.
  constexpr double kBytesPerStart = sizeof(StartRow) + 400.0;
  double starts = 0.0;
  for (const SceneGroup& group : groups) {
    starts += static_cast<double>(total_trials(experiment.starts)) *
              static_cast<double>(group.pairs.size());
  }
  require_memory(kBytesPerStart * starts, "a list of " + fixed_number(starts, 0) + " starts",
                 "reduce --trials", {experiment.file, "", ""});
}

/// The files that `experiment` consists of and those that it names.
std::vector<std::filesystem::path> inputs_of(const Experiment& experiment,
                                             const std::filesystem::path& root) {
  const std::filesystem::path folder = std::filesystem::path(experiment.file).parent_path();
  std::vector<std::filesystem::path> inputs = {experiment.file};
  for (std::size_t i = 1; i < experiment.files.size(); ++i) {
    inputs.push_back(inputs.back().parent_path() / experiment.files[i].path);
  }
  inputs.insert(inputs.end(), {root / experiment.starts.file, folder / experiment.starts.file});
  for (const std::string& name : given_files(experiment)) {
    inputs.insert(inputs.end(), {root / name, folder / name});
  }
  return inputs;
}

}  // namespace

std::set<std::string> given_files(const Experiment& experiment) {
  std::set<std::string> names;
  for (const Variant& variant : experiment.variants) {
    names.insert(variant.poses.name);
    for (const NamedStep& named : variant.pipeline) {
      const auto* const given = dynamic_cast<const GivenMotionStep*>(&*named.step);
      if (given != nullptr) names.insert(given->file().name);
    }
  }
  names.erase("");
  return names;
}

std::string starts_csv(const Experiment& experiment, const std::vector<SceneGroup>& groups) {
  check_list_size(experiment, groups);
  std::vector<StartRow> rows;
  for (const SceneGroup& group : groups) {
    for (const CalibratedPair& pair : group.pairs) {
      for (int trial = 0; trial < total_trials(experiment.starts); ++trial) {
        rows.push_back(
            {group.name, pair.name, trial, start_of(experiment, group.name, pair, trial)});
      }
    }
  }
  return csv_of(start_columns(), rows);
}

namespace {

struct StartsOptions {
  std::filesystem::path experiment;
  std::vector<std::filesystem::path> with;  ///< Workloads, see load_experiment.
  std::filesystem::path out;                ///< The file to write; empty: the stream `out`.
  std::filesystem::path data;               ///< See `data_root`.
  int trials = 0;                           ///< Per scene and sensor; 0: as in the experiment.
};

/// Writes the initial guess of each scene, sensor and trial of the experiment, as a file for the
/// key "starts" of an experiment. Trials that start from the file have bit-identical results.
int starts_command(const StartsOptions& options, const Catalogue& catalogue, std::ostream& out) {
  Experiment experiment = load_experiment(options.experiment, catalogue, options.with);
  if (experiment.starts.is_none) {
    throw InputError(experiment.starts_file, "/starts",
                     "expected starts that are drawn or listed, found \"none\": each trial starts "
                     "at the identity");
  }
  set_trials(experiment.starts, options.trials);
  const std::filesystem::path root = data_root(options.data);
  const std::vector<SceneGroup> groups = scene_groups(experiment, root);
  resolve_starts(experiment, groups, root);
  const std::string bytes = starts_csv(experiment, groups);
  if (options.out.empty()) {
    out << bytes;
  } else {
    replace_output_files({{options.out, bytes}}, inputs_of(experiment, root));
  }
  return 0;
}

class StartsCommand final : public Command {
 public:
  std::string sentence() const override {
    return "Write the starts (initial guesses) of an experiment as a file.";
  }

  void add_options(CLI::App& command) override {
    add_experiment(command, options_.experiment, options_.with);
    add_path(command, "--out", options_.out, "File to write; default standard output.");
    add_data(command, options_.data);
    add_trials(command, options_.trials, "Trials per scene and sensor.");
  }

  int run(const Console& console) override {
    return starts_command(options_, console.catalogue, console.out);
  }

 private:
  StartsOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_starts_command() { return std::make_unique<StartsCommand>(); }

}  // namespace croon::experiments

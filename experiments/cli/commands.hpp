#pragma once

#include <filesystem>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "experiments/run/run_request.hpp"
#include "framework/base/error.hpp"
#include "framework/picture/drawing.hpp"
#include "framework/stage/catalogue.hpp"

namespace croon::experiments {

// The commands of the program, each in a file of its own. A command writes its answer to `out` and
// returns the exit code: 0, or 3 if it is done but something in it failed. It throws InputError,
// before anything is written, if the request is wrong.

struct RunOptions : RunRequest {
  bool plan = false;        ///< Only show what there is to run.
  bool no_share = false;    ///< Run the variants one by one.
  bool fresh = false;       ///< Delete the results in the folder and start over.
  bool same_build = false;  ///< Refuse to go on with trials of another build.
  bool quiet = false;       ///< No progress.
  bool colours = false;     ///< Colours in the tables.
  bool clouds = false;      ///< Write fused clouds.
  bool png = false;         ///< Draw a scene before and after.
};

/// Runs the experiment, or the trials that are missing, and writes the results; progress goes to
/// `err`.
int run_command(const RunOptions& options, const Catalogue& catalogue, std::ostream& out,
                std::ostream& err);

struct MergeOptions {
  std::vector<std::filesystem::path> folders;  ///< Results of shards.
  std::filesystem::path out;
  bool same_build = false;  ///< Refuse trials of different builds.
  bool colours = false;
};

/// Merges the trials of several folders of results of one experiment and writes all files that a
/// run writes: the same bytes as one run of them all. Returns 3 if a trial failed or is missing. If
/// the folders do not belong together, nothing is added to `options.out`.
int merge_command(const MergeOptions& options, std::ostream& out);

struct ExportOptions {
  std::vector<std::filesystem::path> folders;  ///< Of results.
  std::string format;         ///< One of export_formats() or drawing_formats(); empty: md or pdf.
  std::filesystem::path out;  ///< The file to write; empty: `out`.
  std::string figure;         ///< One of figures(); empty: a table.
  std::string width;          ///< One of named_sheets(); empty: what fits.
  std::string units;  ///< Of lengths, "m" or "mm"; empty: m in tables, what fits in figures.
  std::vector<std::string> variants;  ///< Only these; empty: all.
  std::vector<std::string> sensors;   ///< The same; in tables, "all" is all of them together.
  std::vector<std::string> kinds;     ///< Only scenes of these kinds; empty: all.
  std::vector<std::string> columns;   ///< Of a table; empty: the full table.
  bool compact = false;               ///< A table that fits a page.
  bool title = false;                 ///< A figure with its title.
};

/// Throws InputError if two of the paths are one, by any names: a command would show its results
/// twice. `what` they are is a word.
void refuse_repeats(const std::vector<std::filesystem::path>& paths,
                    const std::string& what = "folder");

/// Writes a table of folders of results for a paper, or a figure of one folder.
int export_command(const ExportOptions& options, std::ostream& out);

/// Writes a page of Markdown: for each folder of results what was run, every claim of its
/// experiment beside our number, and the quoted rows of other methods. Returns 3 if a number is out
/// of its band or was not measured.
int claims_command(const std::vector<std::filesystem::path>& folders, std::ostream& out);

struct SimulateOptions {
  std::filesystem::path experiment;
  std::vector<std::filesystem::path> with;  ///< Workloads, see load_experiment.
  std::filesystem::path out;                ///< The folder of the dataset.
  int jobs = 0;                             ///< 0: all cores.
  bool png = false;                         ///< Draw each scene.
  bool quiet = false;                       ///< No progress.
};

/// Writes the simulated scenes of an experiment in the layout of the paper's authors: binary PCD
/// clouds, lists, `truth.json`, `scene_kinds.json`, and `experiment.json`, which gives the same
/// results on them. Scenes that are complete are kept; a folder with anything else is refused.
int simulate_command(const SimulateOptions& options, const Catalogue& catalogue, std::ostream& out,
                     std::ostream& err);

struct DescribeOptions {
  std::vector<std::filesystem::path> experiments;
  std::filesystem::path data;  ///< See `data_root`.
  std::filesystem::path out;   ///< A folder for clouds.csv and ranges.svg; empty: none.
  int jobs = 0;                ///< 0: all cores.
  int scenes = 0;              ///< The first so many scenes of each dataset; 0: all.
  std::string format = "svg";  ///< Of the figure of ranges, one of drawing_formats().
  std::string width;           ///< One of named_sheets(); empty: screen in SVG, else two columns.
};

/// The sheet called `width`; if it is empty, that of a screen in SVG and `on_paper` in other
/// formats. Throws InputError for an unknown name.
Sheet sheet_called(const std::string& width, const std::string& format, const Sheet& on_paper);

/// Describes the clouds of the experiments' datasets, side by side.
int describe_command(const DescribeOptions& options, const Catalogue& catalogue, std::ostream& out);

struct StartsOptions {
  std::filesystem::path experiment;
  std::vector<std::filesystem::path> with;  ///< Workloads, see load_experiment.
  std::filesystem::path out;                ///< The file to write; empty: `out`.
  std::filesystem::path data;               ///< See `data_root`.
  int trials = 0;                           ///< 0: those of the experiment.
};

/// Writes the starts of the experiment, by scene, sensor and trial, as a file that an experiment
/// can name in "starts": with it, trials have the same bits.
int starts_command(const StartsOptions& options, const Catalogue& catalogue, std::ostream& out);

/// The names of the files from which the variants of `experiment` take poses and velocities.
std::set<std::string> given_files(const Experiment& experiment);

/// The content of that file. Call `resolve_starts` before.
std::string starts_csv(const Experiment& experiment, const std::vector<SceneGroup>& groups);

/// Checks experiment files; a folder stands for every *.json below it. The data need not be there.
/// Writes `FILE: ok`, or all faults to `err`. Returns 2 if a file has faults or a folder cannot be
/// read; the other files are checked all the same.
int validate_command(const std::vector<std::filesystem::path>& paths, const Catalogue& catalogue,
                     std::ostream& out, std::ostream& err);

/// Writes the first faults, each as one line, `croon: FILE: WHERE: MESSAGE`, and how many more are.
void print_faults(const InputError& error, std::ostream& err);

}  // namespace croon::experiments

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
// returns the exit code: 0, or 3 if it finished but something in it failed. It throws InputError,
// before anything is written, if the request is wrong.

struct RunOptions : RunRequest {
  bool plan = false;        ///< Only show the trials to run.
  bool no_share = false;    ///< Run the variants one by one.
  bool fresh = false;       ///< Delete the results in the folder and start over.
  bool same_build = false;  ///< Refuse to continue trials of another build.
  bool quiet = false;       ///< No progress.
  bool colours = false;     ///< Colours in the tables.
  bool clouds = false;      ///< Write fused clouds.
  bool png = false;         ///< Draw the first scene before and after calibration.
};

/// Runs the missing trials of the experiment and writes the results; progress goes to `err`.
int run_command(const RunOptions& options, const Catalogue& catalogue, std::ostream& out,
                std::ostream& err);

struct MergeOptions {
  std::vector<std::filesystem::path> folders;  ///< Results of shards.
  std::filesystem::path out;
  bool same_build = false;  ///< Refuse trials of different builds.
  bool colours = false;
};

/// Merges several folders of results of one experiment and writes all files that a run writes,
/// byte for byte as a single run of all trials would. Returns 3 if a trial failed or is missing. If
/// the folders do not belong together, nothing is added to `options.out`.
int merge_command(const MergeOptions& options, std::ostream& out);

struct ExportOptions {
  std::vector<std::filesystem::path> folders;  ///< Folders of results.
  std::string format;         ///< One of export_formats() or drawing_formats(); empty: md or pdf.
  std::filesystem::path out;  ///< The file to write; empty: the stream `out`.
  std::string figure;         ///< One of figures(); empty: a table.
  std::string width;          ///< One of named_sheets(); empty: depends on the format.
  std::string units;  ///< Unit of lengths, "m" or "mm"; empty: m in tables, automatic in figures.
  std::vector<std::string> variants;  ///< Only these variants; empty: all.
  std::vector<std::string> sensors;   ///< Only these; empty: all; "all": the row of all pooled.
  std::vector<std::string> kinds;     ///< Only scenes of these kinds; empty: all.
  std::vector<std::string> columns;   ///< Columns of a table; empty: all, in LaTeX a page.
  bool compact = false;               ///< One row per variant, narrow enough for a page.
  bool title = false;                 ///< Add a title to the figure.
};

/// Throws InputError if two of the paths refer to the same file or folder, because a command would
/// show its results twice. `what` is the word for a path in the message.
void refuse_repeats(const std::vector<std::filesystem::path>& paths,
                    const std::string& what = "folder");

/// Writes, for a paper, a table of one or more folders of results or a figure of one folder.
int export_command(const ExportOptions& options, std::ostream& out);

/// Writes a page of Markdown. For each folder of results it describes the run and lists every claim
/// of the experiment beside our number, and the quoted rows of other methods. Returns 3 if a number
/// is outside its band or was not measured.
int claims_command(const std::vector<std::filesystem::path>& folders, std::ostream& out);

struct ReportOptions {
  std::vector<std::filesystem::path> folders;  ///< Folders of results.
  std::vector<std::string> trials;  ///< Trials to show besides those chosen; needs one folder.
  std::filesystem::path data;       ///< See `data_root`.
};

/// `croon report`: writes report.html to each folder, with views of clouds if the data root has
/// them. Returns 0. Throws InputError for a folder without results, and if one of `trials` cannot
/// be shown (see trial_views).
int report_command(const ReportOptions& options, const Catalogue& catalogue, std::ostream& out);

/// The sheet called `width`. If `width` is empty: the screen sheet for SVG, `on_paper` for other
/// formats. Throws InputError for an unknown name.
Sheet sheet_called(const std::string& width, const std::string& format, const Sheet& on_paper);

/// The names of the files from which the variants of `experiment` read poses and velocities.
std::set<std::string> given_files(const Experiment& experiment);

/// The file that starts_command writes. Call `resolve_starts` first.
std::string starts_csv(const Experiment& experiment, const std::vector<SceneGroup>& groups);

/// Checks experiment files, and for a folder every *.json below it. The data need not exist. Writes
/// `FILE: ok`, or all faults to `err`. Returns 2 if a file has faults or a folder cannot be read;
/// the other files are checked nevertheless.
int validate_command(const std::vector<std::filesystem::path>& paths, const Catalogue& catalogue,
                     std::ostream& out, std::ostream& err);

/// Writes the first faults, one per line as `croon: FILE: WHERE: MESSAGE`, and the number of
/// further faults.
void print_faults(const InputError& error, std::ostream& err);

/// Writes the notes on former names of keys, one per line as `croon: warning: FILE: WHERE:
/// MESSAGE`.
void print_notes(const std::vector<Fault>& notes, std::ostream& err);

}  // namespace croon::experiments

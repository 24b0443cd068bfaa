#include "experiments/cli/commands.hpp"

#include <tbb/info.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "experiments/cli/command.hpp"
#include "experiments/cli/options.hpp"
#include "experiments/file/experiment.hpp"
#include "experiments/report/plots.hpp"
#include "experiments/report/result_sections.hpp"
#include "experiments/report/result_tables.hpp"
#include "experiments/run/sensor_pairs.hpp"
#include "experiments/session/output_files.hpp"
#include "framework/base/error.hpp"
#include "framework/base/threads.hpp"
#include "framework/document/renderers.hpp"
#include "framework/picture/writers.hpp"
#include "framework/pipeline/cloud_description.hpp"

namespace croon::experiments {
namespace {

struct DescribeOptions {
  std::vector<std::filesystem::path> experiments;
  std::filesystem::path data;  ///< See `data_root`.
  std::filesystem::path out;   ///< A folder for clouds.csv and ranges.svg; empty: none.
  int jobs = 0;                ///< 0: all cores.
  int scenes = 0;              ///< Maximum number of scenes per dataset; 0: all.
  std::string format = "svg";  ///< Of the figure of ranges: one of drawing_formats().
  std::string width;           ///< One of named_sheets(); empty: screen in SVG, else two columns.
};

/// A scene and the dataset that it belongs to.
struct NamedScene {
  std::string dataset;
  Scene scene;
};

std::vector<NamedScene> scenes_of(const DescribeOptions& options, const Catalogue& catalogue) {
  std::vector<NamedScene> named;
  std::vector<Fault> faults;
  for (const std::filesystem::path& file : options.experiments) {
    collect_faults(faults, [&] {
      const Experiment experiment = load_experiment(file, catalogue);
      int left = options.scenes > 0 ? options.scenes : -1;
      std::vector<Scene> scenes = dataset_scenes(experiment, data_root(options.data));
      for (Scene& scene : scenes) {
        if (left-- == 0) break;
        named.push_back({experiment.name, std::move(scene)});
      }
    });
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  return named;
}

/// The stage `ransac`, which finds the plane with the most points, with default parameters.
params::Slot<GroundExtractor> extractor_of(const Catalogue& catalogue) {
  const nlohmann::json json = {{"type", "ransac"}};
  std::vector<Fault> faults;
  const auto extractor = catalogue.slot<GroundExtractor>(params::Node(json, "", faults));
  if (!faults.empty()) throw std::logic_error("there is no ground extractor called ransac");
  return extractor;
}

/// Descriptions of the clouds of a scene, and the sensors whose clouds are empty.
struct DescribedScene {
  std::vector<CloudDescription> clouds;
  std::vector<std::string> empty;
};

DescribedScene describe_scene(const NamedScene& named, const GroundExtractor& extractor) {
  DescribedScene described;
  const auto add = [&](const SensorScan& scan, const Points& points) {
    if (points.empty()) {
      described.empty.push_back(scan.sensor);
      return false;
    }
    try {
      described.clouds.push_back(description_of(points, extractor));
    } catch (const StageError& error) {
      throw InputError(scan.file, "", error.what());
    }
    CloudDescription& cloud = described.clouds.back();
    cloud.dataset = named.dataset;
    cloud.scene = named.scene.name;
    cloud.kind = named.scene.kind;
    cloud.sensor = scan.sensor;
    return true;
  };
  const Points reference = named.scene.reference.load().points;
  const bool has_reference = add(named.scene.reference, reference);
  const KdTree tree(reference);
  for (const SensorScan& scan : named.scene.sensors) {
    const Points points = scan.load().points;
    const bool has_points = add(scan, points);
    if (has_points && has_reference && scan.truth) {
      add_overlap(described.clouds.back(), points, tree, *scan.truth);
    }
  }
  return described;
}

/// A line for each sensor with empty clouds, which the table omits.
std::string empty_clouds_text(const std::vector<NamedScene>& scenes,
                              const std::vector<DescribedScene>& described) {
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> empty;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    for (const std::string& sensor : described[i].empty) {
      empty[{scenes[i].dataset, sensor}].push_back(scenes[i].scene.name);
    }
  }
  std::string text;
  for (const auto& [name, of] : empty) {
    text += (text.empty() ? "\n" : "") + name.second + " of " + name.first +
            " has no points in scene " + of.front() +
            (of.size() > 1 ? " and " + std::to_string(of.size() - 1) + " more" : "") + "\n";
  }
  return text;
}

/// The files that describe `clouds`, in `folder`.
std::vector<OutputFile> files_in(const std::filesystem::path& folder,
                                 const std::vector<CloudDescription>& clouds,
                                 const DrawingFormat& writer, const Sheet& sheet) {
  return {{folder / "clouds.csv", clouds_csv(clouds)},
          {folder / (std::string("ranges.") + writer.name),
           writer.bytes(ranges_chart(clouds, {sheet}))}};
}

/// Creates the output folder and its missing parents; finally removes those that are still empty.
class OutputFolders {
 public:
  explicit OutputFolders(const std::filesystem::path& folder) {
    std::error_code ignored;
    for (auto part = std::filesystem::absolute(folder);
         !std::filesystem::exists(part, ignored) && part.has_relative_path();
         part = part.parent_path()) {
      made_.push_back(part);
    }
    make_folder(folder);
  }
  ~OutputFolders() {
    std::error_code ignored;
    for (const std::filesystem::path& folder : made_) std::filesystem::remove(folder, ignored);
  }
  OutputFolders(const OutputFolders&) = delete;
  OutputFolders& operator=(const OutputFolders&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  ///< Innermost first.
};

/// Describes the clouds of the experiments' datasets, side by side.
int describe_command(const DescribeOptions& options, const Catalogue& catalogue,
                     std::ostream& out) {
  const DrawingFormat& writer = called("--format", options.format, drawing_formats());
  const Sheet sheet = sheet_called(options.width, options.format, kTwoColumns);
  refuse_repeats(options.experiments, "experiment");
  const std::vector<NamedScene> scenes = scenes_of(options, catalogue);
  std::optional<OutputFolders> folders;
  if (!options.out.empty()) {
    // Before the clouds are read, which takes long.
    folders.emplace(options.out);
    refuse_to_replace(files_in(options.out, {}, writer, sheet));
  }
  const params::Slot<GroundExtractor> extractor = extractor_of(catalogue);
  std::vector<DescribedScene> by_scene(scenes.size());
  on_threads(options.jobs > 0 ? options.jobs : tbb::info::default_concurrency(), [&] {
    for_each_in_parallel(
        scenes.size(), [&](std::size_t i) { by_scene[i] = describe_scene(scenes[i], *extractor); });
  });
  std::vector<CloudDescription> clouds;
  for (const DescribedScene& of_scene : by_scene) {
    clouds.insert(clouds.end(), of_scene.clouds.begin(), of_scene.clouds.end());
  }
  if (!options.out.empty()) replace_output_files(files_in(options.out, clouds, writer, sheet));
  out << text_section(clouds_section(clouds)) << empty_clouds_text(scenes, by_scene);
  return 0;
}

class DescribeCommand final : public Command {
 public:
  std::string sentence() const override { return "Describe the clouds of experiments' datasets."; }

  void add_options(CLI::App& command) override {
    add_path(command, "EXPERIMENT", options_.experiments, "Experiment files (JSON).")->required();
    add_data(command, options_.data);
    add_path(command, "--out", options_.out, "Folder for clouds.csv and ranges.svg.");
    add_text(command, "--format", options_.format,
             "Format of the figure of ranges: " + names_of(drawing_formats()) + "; default svg.",
             "a format");
    add_width(command, options_.width);
    command.add_option("--scenes", options_.scenes, "Use only the first N scenes of each dataset.")
        ->check(CLI::Range(1, 1000000));
    add_jobs(command, options_.jobs);
  }

  int run(const Console& console) override {
    return describe_command(options_, console.catalogue, console.out);
  }

 private:
  DescribeOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_describe_command() { return std::make_unique<DescribeCommand>(); }

}  // namespace croon::experiments

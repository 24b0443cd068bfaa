#include "experiments/cli/commands.hpp"

#include <tbb/info.h>

#include <nlohmann/json.hpp>

#include "experiments/file/experiment.hpp"
#include "experiments/report/output_files.hpp"
#include "experiments/report/plots.hpp"
#include "experiments/report/result_tables.hpp"
#include "experiments/report/run_text.hpp"
#include "experiments/run/sensor_pairs.hpp"
#include "framework/base/error.hpp"
#include "framework/base/threads.hpp"
#include "framework/picture/writers.hpp"
#include "framework/pipeline/cloud_description.hpp"

namespace croon::experiments {
namespace {

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

/// The plane with the most points, with the defaults of the stage.
params::Slot<GroundExtractor> extractor_of(const Catalogue& catalogue) {
  const nlohmann::json json = {{"type", "ransac"}};
  std::vector<Fault> faults;
  const auto extractor = catalogue.slot<GroundExtractor>(params::Node(json, "", faults));
  if (!faults.empty()) throw std::logic_error("there is no ground extractor called ransac");
  return extractor;
}

/// Describes all clouds of a scene that have points.
std::vector<CloudDescription> describe_scene(const NamedScene& named,
                                             const GroundExtractor& extractor) {
  std::vector<CloudDescription> clouds;
  const auto add = [&](const SensorScan& scan, const Points& points) {
    try {
      clouds.push_back(description_of(points, extractor));
    } catch (const StageError& error) {
      throw InputError(scan.file, "", error.what());
    }
    clouds.back().dataset = named.dataset;
    clouds.back().scene = named.scene.name;
    clouds.back().kind = named.scene.kind;
    clouds.back().sensor = scan.sensor;
  };
  const Points reference = named.scene.reference.load().points;
  if (reference.empty()) return {};
  add(named.scene.reference, reference);
  const KdTree tree(reference);
  for (const SensorScan& scan : named.scene.sensors) {
    const Points points = scan.load().points;
    if (points.empty()) continue;
    add(scan, points);
    if (scan.truth) add_overlap(clouds.back(), points, tree, *scan.truth);
  }
  return clouds;
}

/// The writer called `options.format`. Throws InputError if there is none.
const DrawingFormat& writer_of(const DescribeOptions& options) {
  std::vector<std::string> names;
  for (const DrawingFormat& format : drawing_formats()) {
    if (options.format == format.name) return format;
    names.emplace_back(format.name);
  }
  throw InputError("", "--format",
                   "unknown format \"" + options.format + "\"" + name_hint(options.format, names));
}

void write_files(const std::filesystem::path& folder, const std::vector<CloudDescription>& clouds,
                 const DrawingFormat& writer, const Sheet& sheet) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "", "cannot be made: " + error.message());
  replace_output_files({{folder / "clouds.csv", clouds_csv(clouds)},
                        {folder / (std::string("ranges.") + writer.name),
                         writer.bytes(ranges_chart(clouds, {sheet}))}});
}

}  // namespace

int describe_command(const DescribeOptions& options, const Catalogue& catalogue,
                     std::ostream& out) {
  const DrawingFormat& writer = writer_of(options);
  const Sheet sheet = sheet_called(options.width, options.format, kTwoColumns);
  const std::vector<NamedScene> scenes = scenes_of(options, catalogue);
  const params::Slot<GroundExtractor> extractor = extractor_of(catalogue);
  std::vector<std::vector<CloudDescription>> by_scene(scenes.size());
  on_threads(options.jobs > 0 ? options.jobs : tbb::info::default_concurrency(), [&] {
    for_each_in_parallel(
        scenes.size(), [&](std::size_t i) { by_scene[i] = describe_scene(scenes[i], *extractor); });
  });
  std::vector<CloudDescription> clouds;
  for (const auto& of_scene : by_scene) {
    clouds.insert(clouds.end(), of_scene.begin(), of_scene.end());
  }
  if (!options.out.empty()) write_files(options.out, clouds, writer, sheet);
  out << "median over scenes (least to largest); ground: within 0.2 m of the largest plane;\n"
         "distance to the reference's nearest point, of points that have one within 1 m "
         "(overlap)\n\n"
      << clouds_text(clouds);
  return 0;
}

}  // namespace croon::experiments

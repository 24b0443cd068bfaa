#include "experiments/cli/starts_command.hpp"

#include "experiments/cli/output_file.hpp"
#include "experiments/file/experiment.hpp"
#include "experiments/report/csv_row.hpp"
#include "experiments/run/run_request.hpp"
#include "experiments/run/sensor_pairs.hpp"
#include "experiments/run/start_file.hpp"
#include "experiments/run/starts.hpp"

namespace croon::experiments {
namespace {

std::string start_line(const std::string& scene, const std::string& sensor, int trial,
                       const Start& start) {
  CsvRow row;
  row.text(scene).text(sensor).count(trial);
  for (const double value : start.translation) row.number(value);
  for (const double value : start.rotation.coeffs()) row.number(value);
  return row.line();
}

}  // namespace

std::string starts_csv(const Experiment& experiment, const std::vector<Scene>& scenes) {
  std::string bytes = std::string(kStartHeader) + "\n";
  for (const Scene& scene : scenes) {
    for (const SensorScan& scan : scene.sensors) {
      for (int trial = 0; trial < total_trials(experiment.starts); ++trial) {
        bytes += start_line(scene.name, scan.sensor, trial,
                            start_of(experiment, scene.name, scan, trial));
      }
    }
  }
  return bytes;
}

int starts_command(const StartsOptions& options, const Catalogue& catalogue, std::ostream& out) {
  Experiment experiment = load_experiment(options.experiment, catalogue);
  set_trials(experiment.starts, options.trials);
  const std::filesystem::path root = data_root(options.data);
  const std::vector<Scene> scenes = scenes_of(experiment, root);
  resolve_starts(experiment, scenes, root);
  const std::string bytes = starts_csv(experiment, scenes);
  if (options.out.empty()) {
    out << bytes;
  } else {
    write_output_file(options.out, bytes, options.experiment);
  }
  return 0;
}

}  // namespace croon::experiments

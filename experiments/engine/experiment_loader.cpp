#include "experiments/engine/experiment_loader.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/engine/names.hpp"
#include "experiments/engine/variants.hpp"
#include "framework/base/error.hpp"
#include "framework/params/json_file.hpp"

namespace croon::experiments {
namespace {

using params::Node;

constexpr std::uint64_t kLargestSeed = 9007199254740992;  // 2^53: exact in every JSON reader.

/// The centres in the order of StartCentre.
const std::vector<std::string> kCentres = {"truth", "nominal", "initial"};

/// StartRule as it stands in the file.
struct StartKeys {
  std::string around = kCentres.front();
  double rotation_deg = StartRule{}.rotation_deg;
  double translation_m = StartRule{}.translation_m;
  int trials = StartRule{}.trials;
};

const params::Table<StartKeys>& start_table() {
  static const params::Table<StartKeys> table = {
      params::choice("around", &StartKeys::around, kCentres,
                     "The pose that starts are drawn around."),
      params::number("rotation_deg", &StartKeys::rotation_deg, {0.0, 180.0},
                     "Half range of roll, pitch and yaw; 180 is any rotation, uniform on SO(3)."),
      params::number("translation_m", &StartKeys::translation_m, {0.0, 1e6},
                     "Half range of x, y and z in reference axes."),
      params::integer("trials", &StartKeys::trials, {1, kMaxTrials},
                      "Starts per variant, scene and sensor."),
  };
  return table;
}

const params::Table<SuccessBounds>& success_table() {
  static const params::Table<SuccessBounds> table = {
      params::number("rotation_deg", &SuccessBounds::rotation_deg, {0.0, 180.0},
                     "Largest angle between the estimate and the truth."),
      params::number("translation_m", &SuccessBounds::translation_m, {0.0, 1e6},
                     "Largest distance between the estimate and the truth."),
  };
  return table;
}

/// The struct that `table` reads from the optional object `key`; its defaults where the key is
/// missing.
template <class P>
P read_optional(const Node& root, const std::string& key, const params::Table<P>& table,
                const Catalogue& catalogue) {
  if (!root.has(key) || !root.member(key).is_object()) return P{};
  return table.read(root.member(key), {}, catalogue);
}

StartRule read_starts(const Node& root, const Catalogue& catalogue) {
  const StartKeys keys = read_optional(root, "starts", start_table(), catalogue);
  const auto centre = std::find(kCentres.begin(), kCentres.end(), keys.around);
  return {static_cast<StartCentre>(centre - kCentres.begin()), keys.rotation_deg,
          keys.translation_m, keys.trials};
}

std::uint64_t read_seed(const Node& root) {
  if (!root.has("seed")) return Experiment{}.seed;
  const Node node = root.member("seed");
  if (node.value().is_number_unsigned()) {
    const std::uint64_t seed = node.value().get<std::uint64_t>();
    if (seed <= kLargestSeed) return seed;
  }
  node.expected("a whole number from 0 to 9007199254740992");
  return 0;
}

std::string read_name(const Node& root) {
  std::string name;
  if (!root.require("name") || !root.member("name").read(name)) return "";
  if (!is_folder_name(name)) {
    root.member("name").expected(
        "a name for a folder: letters, digits, _ . and -, not starting with a dot");
  }
  return name;
}

std::string read_description(const Node& root) {
  std::string description;
  if (root.has("description")) root.member("description").read(description);
  return description;
}

}  // namespace

const char* centre_name(StartCentre centre) {
  return kCentres.at(static_cast<std::size_t>(centre)).c_str();
}

Experiment load_experiment(const std::filesystem::path& path, const Catalogue& catalogue) {
  std::vector<Fault> faults;
  const nlohmann::json json = params::read_json_file(path, faults);
  const Node root(json, path.string(), faults);
  Experiment experiment;
  experiment.file = path.string();
  if (root.is_object()) {
    root.refuse_unknown_keys({"name", "description", "dataset", "starts", "seed", "success",
                              "pipeline", "variants", "grid"});
    experiment.name = read_name(root);
    experiment.description = read_description(root);
    if (root.require("dataset")) {
      experiment.dataset = catalogue.slot<Dataset>(root.member("dataset"));
    }
    experiment.starts = read_starts(root, catalogue);
    experiment.seed = read_seed(root);
    experiment.success = read_optional(root, "success", success_table(), catalogue);
    if (root.require("pipeline")) experiment.variants = read_variants(root, catalogue, faults);
  }
  if (!faults.empty()) throw InputError(without_repeats(faults));
  return experiment;
}

}  // namespace croon::experiments

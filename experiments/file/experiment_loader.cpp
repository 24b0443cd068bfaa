#include "experiments/file/experiment_loader.hpp"

#include <nlohmann/json.hpp>

#include "experiments/file/names.hpp"
#include "experiments/file/start_rule.hpp"
#include "experiments/file/variants.hpp"
#include "framework/base/error.hpp"
#include "framework/params/json_file.hpp"

namespace croon::experiments {
namespace {

using params::Node;

constexpr std::uint64_t kLargestSeed = 9007199254740992;  // 2^53: exact in every JSON reader.

SuccessBounds read_success(const Node& root, const Catalogue& catalogue) {
  if (!root.has("success") || !root.member("success").is_object()) return {};
  return success_table().read(root.member("success"), {}, catalogue);
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

std::vector<std::string> variant_names(const std::vector<Variant>& variants) {
  std::vector<std::string> names;
  for (const Variant& variant : variants) names.push_back(variant.name);
  return names;
}

}  // namespace

Experiment load_experiment(const std::filesystem::path& path, const Catalogue& catalogue) {
  std::vector<Fault> faults;
  const nlohmann::json json = params::read_json_file(path, faults);
  const Node root(json, path.string(), faults);
  Experiment experiment;
  experiment.file = path.string();
  if (root.is_object()) {
    root.refuse_unknown_keys({"name", "description", "dataset", "starts", "seed", "success",
                              "loops", "pipeline", "variants", "grid", "expect", "quoted"});
    experiment.name = read_name(root);
    experiment.description = read_description(root);
    if (root.require("dataset")) {
      experiment.dataset = catalogue.slot<Dataset>(root.member("dataset"));
    }
    experiment.starts = read_start_rule(root, catalogue);
    experiment.seed = read_seed(root);
    experiment.success = read_success(root, catalogue);
    if (root.has("loops")) root.member("loops").read(experiment.loops);
    if (root.require("pipeline")) experiment.variants = read_variants(root, catalogue, faults);
    experiment.claims = read_claims(root, variant_names(experiment.variants));
  }
  if (!faults.empty()) throw InputError(without_repeats(faults));
  return experiment;
}

}  // namespace croon::experiments

#include "experiments/file/experiment.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/file/experiment_keys.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/data_path.hpp"
#include "framework/io/digest.hpp"
#include "framework/params/json_file.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using params::Node;

constexpr const char* kExtends = "extends";
constexpr const char* kName = "name";
constexpr const char* kPipeline = "pipeline";
constexpr std::size_t kMaxFiles = 16;

/// The keys of an experiment file and of the files that it extends.
struct MergedFile {
  json keys;
  params::MemberOrigins origins;
  std::vector<ExperimentFile> files;
};

/// A file that another file extends: its path, the path as written there, and its position there.
struct Extension {
  fs::path path;
  std::string written;
  std::string pointer;
};

/// The files that `keys` of the file `path` extend, in order. Appends a fault if the value is not a
/// path or a list of paths.
std::vector<Extension> extensions_of(const json& keys, const fs::path& path,
                                     std::vector<Fault>& faults) {
  std::vector<Extension> extensions;
  if (!keys.contains(kExtends)) return extensions;
  const auto add = [&](const Node& node) {
    std::string written;
    if (!node.read(written)) return;
    // A file name ends at a null character.
    if (written.empty() || written.find('\0') != std::string::npos) {
      node.expected("the path of an experiment file");
      return;
    }
    const fs::path extended = (path.parent_path() / written).lexically_normal();
    extensions.push_back({extended, written, node.pointer()});
  };
  const Node node = Node(keys, path.string(), faults).member(kExtends);
  if (node.value().is_array()) {
    params::for_each_element(node, add);
  } else {
    add(node);
  }
  return extensions;
}

/// Adds the keys of `over`, replacing existing keys. The names of the experiments are joined.
void overlay(MergedFile& merged, MergedFile over) {
  const auto name = merged.keys.find(kName);
  if (name != merged.keys.end() && name->is_string() && over.keys.contains(kName) &&
      over.keys[kName].is_string()) {
    over.keys[kName] = name->get<std::string>() + "_" + over.keys[kName].get<std::string>();
  }
  merged.keys.update(over.keys);
  for (auto& [key, origin] : over.origins) merged.origins[key] = std::move(origin);
  merged.files.insert(merged.files.end(), over.files.begin(), over.files.end());
}

/// Throws InputError unless the keys of `file`, which are merged with others, are an object.
void require_object(const MergedFile& merged, const fs::path& file, std::vector<Fault>& faults) {
  if (merged.keys.is_object()) return;
  faults.push_back({file.string(), "/", "expected an object"});
  throw InputError(std::move(faults));
}

MergedFile read_merged(const std::string& text, const fs::path& path, std::vector<fs::path> chain,
                       std::vector<Fault>& faults);

/// Reads a file that the file `path` extends. Throws InputError if it cannot be read, because
/// without its keys the others cannot be checked. `chain` are the files that led here, ending with
/// `path`.
MergedFile read_extension(const Extension& extension, const fs::path& path,
                          const std::vector<fs::path>& chain, std::vector<Fault>& faults) {
  const fs::path& extended = extension.path;
  const auto refuse = [&](const std::string& message) {
    faults.push_back({path.string(), extension.pointer, message});
    throw InputError(std::move(faults));
  };
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(extended, error);
  const bool is_file = !error && fs::is_regular_file(extended, error);
  // The name is too long, or links form a loop.
  if (error && error != std::errc::no_such_file_or_directory) {
    refuse("expected an experiment file, found " + extended.string() + ": " + error.message());
  }
  if (std::find(chain.begin(), chain.end(), canonical) != chain.end()) {
    refuse("expected another file, found " + extended.string() + ", which extends this one");
  }
  if (chain.size() >= kMaxFiles) {
    refuse("expected at most " + std::to_string(kMaxFiles) + " files that extend each other");
  }
  if (!is_file) {
    refuse("expected an experiment file, found " + found_instead_of_file(extended) + " at " +
           extended.string() + missing_path_hint("", extended));
  }
  MergedFile merged = read_merged(params::read_json_text(extended), extended, chain, faults);
  require_object(merged, extended, faults);
  merged.files.front().path = extension.written;
  return merged;
}

/// Reads `text`, the content of the file `path`, and the files that it extends. `chain` are the
/// files that led here.
MergedFile read_merged(const std::string& text, const fs::path& path, std::vector<fs::path> chain,
                       std::vector<Fault>& faults) {
  const ExperimentFile file = {path.filename().string(), sha256_of_text(text)};
  const json own = params::parse_json(text, path.string(), faults);
  if (!own.is_object()) return {own, {}, {file}};
  std::error_code ignored;  // The file has already been read.
  chain.push_back(fs::weakly_canonical(path, ignored));
  const std::size_t faults_before = faults.size();
  const std::vector<Extension> extensions = extensions_of(own, path, faults);
  if (faults.size() > faults_before) throw InputError(std::move(faults));
  MergedFile merged = {json::object(), {}, {}};
  for (const Extension& extension : extensions) {
    overlay(merged, read_extension(extension, path, chain, faults));
  }
  for (const auto& [key, value] : own.items()) {
    if (key == kExtends) continue;
    merged.keys[key] = value;
    merged.origins[key] = {path.string(), key};
  }
  merged.files.insert(merged.files.begin(), file);
  return merged;
}

/// Sets the variant of claims without one to the first variant, and notes a fault for each claim
/// with an unknown variant.
void check_variants(const Node& root, Experiment& experiment) {
  std::vector<std::string> names;
  for (const Variant& variant : experiment.variants) names.push_back(variant.name);
  if (names.empty()) return;
  for (Claim& claim : experiment.claims) {
    if (claim.variant.empty()) claim.variant = names.front();
  }
  if (!root.has("claims") || !root.value().at("claims").is_array()) return;
  params::for_each_element(root.member("claims"), [&](const Node& element) {
    if (!element.has("variant") || !element.value().at("variant").is_string()) return;
    const std::string name = element.value().at("variant");
    if (std::find(names.begin(), names.end(), name) != names.end()) return;
    element.member("variant").fault("there is no variant \"" + name + "\"" +
                                    name_hint(name, names));
  });
}

Experiment read_merged_experiment(const MergedFile& merged, const fs::path& path,
                                  const Catalogue& catalogue, std::vector<Fault>& faults) {
  std::vector<Fault> notes;
  const Node root = Node(merged.keys, path.string(), faults, merged.origins).noting(notes);
  Experiment experiment;
  if (root.is_object()) {
    ExperimentKeys keys = experiment_table().read(root, {}, catalogue);
    if (keys.pipeline) keys.variants = make_variants(keys, root, catalogue, faults);
    experiment = std::move(keys);
    check_variants(root, experiment);
    const std::string too_long = why_too_long(experiment.name, kMaxFileNameBytes);
    if (!too_long.empty()) root.member(kName).fault(too_long);
  }
  if (!faults.empty()) throw InputError(without_repeats(faults));
  experiment.file = path.string();
  const auto starts = merged.origins.find("starts");
  experiment.starts_file = starts == merged.origins.end() ? experiment.file : starts->second.file;
  experiment.files = merged.files;
  experiment.merged = std::make_shared<const json>(merged.keys);
  for (const Variant& variant : experiment.variants) add_notes(variant.pipeline, notes);
  experiment.notes = std::move(notes);
  return experiment;
}

/// Keeps the JSON of stages without building them.
class UnbuiltStages final : public params::StageBuilder {
 public:
  params::BuiltStage build(const std::string&, const Node& node) const override {
    return {nullptr, "", params::node_json(node)};
  }
};

}  // namespace

Experiment load_experiment(const fs::path& path, const Catalogue& catalogue,
                           const std::vector<fs::path>& workloads) {
  return parse_experiment(params::read_json_text(path), path, catalogue, workloads);
}

Experiment parse_experiment(const std::string& text, const fs::path& path,
                            const Catalogue& catalogue, const std::vector<fs::path>& workloads) {
  std::vector<Fault> faults;
  MergedFile merged = read_merged(text, path, {}, faults);
  for (const fs::path& workload : workloads) {
    require_object(merged, path, faults);
    MergedFile over = read_merged(params::read_json_text(workload), workload, {}, faults);
    require_object(over, workload, faults);
    overlay(merged, std::move(over));
  }
  return read_merged_experiment(merged, path, catalogue, faults);
}

std::vector<Fault> validate_experiment(const fs::path& path, const Catalogue& catalogue) {
  std::vector<Fault> faults, notes;
  const MergedFile merged = read_merged(params::read_json_text(path), path, {}, faults);
  if (!merged.keys.is_object() || merged.keys.contains(kPipeline)) {
    return read_merged_experiment(merged, path, catalogue, faults).notes;
  }
  const Node root(merged.keys, path.string(), faults, merged.origins);
  workload_table().read(root.noting(notes), {}, catalogue);
  if (!faults.empty()) throw InputError(without_repeats(faults));
  return notes;
}

std::string location_of(const Experiment& experiment, const Variant& variant,
                        const NamedStep& step) {
  const std::string text = "the step \"" + step.name + "\"";
  return experiment.variants.size() > 1 ? text + " of the variant \"" + variant.name + "\"" : text;
}

nlohmann::ordered_json experiment_json(const Experiment& experiment) {
  auto whole = nlohmann::ordered_json::parse(kept_table().json(experiment));
  nlohmann::ordered_json& variants = whole["variants"] = nlohmann::ordered_json::array();
  for (const Variant& variant : experiment.variants) {
    variants.push_back({{"name", variant.name}, {"pipeline", pipeline_json(variant.pipeline)}});
  }
  return whole;
}

Experiment read_experiment_json(const json& stored, const std::string& file) {
  std::vector<Fault> faults;
  if (!stored.is_object()) throw InputError(file, "/experiment", "expected an object");
  if (stored.contains("variants") && stored["variants"].size() > kMaxVariants) {
    throw InputError(file, "/experiment/variants",
                     "expected at most " + std::to_string(kMaxVariants) + " variants");
  }
  Experiment experiment =
      kept_table().read(Node(stored, file, faults), {"variants"}, UnbuiltStages());
  if (!faults.empty()) throw InputError(faults);
  experiment.file = file;
  return experiment;
}

}  // namespace croon::experiments

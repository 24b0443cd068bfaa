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
constexpr std::size_t kMostFiles = 16;

/// The keys of an experiment file and of those that it extends.
struct MergedFile {
  json keys;
  params::MemberOrigins origins;
  std::vector<ExperimentFile> files;
};

/// Keys that were renamed, under their present names.
json with_present_names(const json& keys, const std::string& file, std::vector<Fault>& faults,
                        params::MemberOrigins& origins) {
  json renamed = json::object();
  for (const auto& [key, value] : keys.items()) {
    const auto rename = renamed_keys().find(key);
    const std::string present = rename == renamed_keys().end() ? key : rename->second;
    if (present != key && keys.contains(present)) {
      faults.push_back({file, "/" + key,
                        "expected no \"" + key + "\" beside \"" + present + "\", its new name"});
      continue;
    }
    renamed[present] = value;
    origins[present] = {file, key};
  }
  return renamed;
}

/// The file that `keys` of the file `path` extend; empty if there is none.
fs::path extended_file(const json& keys, const fs::path& path, std::vector<Fault>& faults) {
  if (!keys.contains(kExtends)) return {};
  std::string extended;
  const Node node = Node(keys, path.string(), faults).member(kExtends);
  if (!node.read(extended)) return {};
  if (!extended.empty()) return (path.parent_path() / extended).lexically_normal();
  node.expected("the path of an experiment file");
  return {};
}

MergedFile read_merged(const std::string& text, const fs::path& path, std::vector<fs::path> chain,
                       std::vector<Fault>& faults);

/// Reads the file that `own`, the keys of the file `path`, extends; without keys if there is none.
/// Throws InputError if it cannot be had: what its keys are is then not known, so nothing more can
/// be said of `own`. `chain` are the files that led here, `path` the last of them.
MergedFile read_extended(const json& own, const fs::path& path, const std::vector<fs::path>& chain,
                         std::vector<Fault>& faults) {
  const std::size_t faults_before = faults.size();
  const fs::path extended = extended_file(own, path, faults);
  if (faults.size() > faults_before) throw InputError(std::move(faults));
  if (extended.empty()) return {json::object(), {}, {}};
  const auto refuse = [&](const std::string& file, const std::string& where,
                          const std::string& message) {
    faults.push_back({file, where, message});
    throw InputError(std::move(faults));
  };
  const std::string key = std::string("/") + kExtends;
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(extended, error);
  const bool is_file = !error && fs::is_regular_file(extended, error);
  // A name that is too long, a loop of links.
  if (error && error != std::errc::no_such_file_or_directory) {
    refuse(path.string(), key,
           "expected an experiment file, found " + extended.string() + ": " + error.message());
  }
  if (std::find(chain.begin(), chain.end(), canonical) != chain.end()) {
    refuse(path.string(), key,
           "expected another file, found " + extended.string() + ", which extends this one");
  }
  if (chain.size() >= kMostFiles) {
    refuse(path.string(), key,
           "expected at most " + std::to_string(kMostFiles) + " files that extend each other");
  }
  if (!is_file) {
    refuse(path.string(), key,
           "expected an experiment file, found " + found_instead_of_file(extended) + " at " +
               extended.string() + missing_path_hint("", extended));
  }
  MergedFile base = read_merged(params::read_json_text(extended), extended, chain, faults);
  if (!base.keys.is_object()) refuse(extended.string(), "/", "expected an object");
  base.files.front().path = own.at(kExtends);
  return base;
}

/// Reads `text`, that of the file `path`, and the files that it extends. `chain` are the files that
/// led here.
MergedFile read_merged(const std::string& text, const fs::path& path, std::vector<fs::path> chain,
                       std::vector<Fault>& faults) {
  const ExperimentFile file = {path.filename().string(), sha256_of_text(text)};
  const json own = params::parse_json(text, path.string(), faults);
  if (!own.is_object()) return {own, {}, {file}};
  std::error_code ignored;  // The file has been read.
  chain.push_back(fs::weakly_canonical(path, ignored));
  MergedFile merged = read_extended(own, path, chain, faults);
  json renamed = with_present_names(own, path.string(), faults, merged.origins);
  renamed.erase(kExtends);
  merged.keys.update(renamed);
  merged.files.insert(merged.files.begin(), file);
  return merged;
}

/// Gives claims that name no variant the first one, and notes a fault for each that names one that
/// does not exist.
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

/// Keeps the JSON of stages and builds none.
class UnbuiltStages final : public params::StageBuilder {
 public:
  params::BuiltStage build(const std::string&, const Node& node) const override {
    return {nullptr, "", params::node_json(node)};
  }
};

}  // namespace

Experiment load_experiment(const fs::path& path, const Catalogue& catalogue) {
  return parse_experiment(params::read_json_text(path), path, catalogue);
}

Experiment parse_experiment(const std::string& text, const fs::path& path,
                            const Catalogue& catalogue) {
  std::vector<Fault> faults;
  const MergedFile merged = read_merged(text, path, {}, faults);
  const Node root(merged.keys, path.string(), faults, merged.origins);
  Experiment experiment;
  if (root.is_object()) {
    ExperimentKeys keys = experiment_table().read(root, {}, catalogue);
    if (keys.pipeline) keys.variants = make_variants(keys, root, catalogue, faults);
    experiment = std::move(keys);
    check_variants(root, experiment);
    const std::string too_long = why_too_long(experiment.name, kMaxFileNameBytes);
    if (!too_long.empty()) root.member("name").fault(too_long);
  }
  if (!faults.empty()) throw InputError(without_repeats(faults));
  experiment.file = path.string();
  const auto starts = merged.origins.find("starts");
  experiment.starts_file = starts == merged.origins.end() ? experiment.file : starts->second.file;
  experiment.files = merged.files;
  experiment.merged = merged.keys.dump();
  return experiment;
}

std::string place_of(const Experiment& experiment, const Variant& variant, const NamedStep& step) {
  const std::string place = "the step \"" + step.name + "\"";
  return experiment.variants.size() > 1 ? place + " of the variant \"" + variant.name + "\""
                                        : place;
}

std::string experiment_json(const Experiment& experiment) {
  std::string variants;
  for (const Variant& variant : experiment.variants) {
    variants += (variants.empty() ? "" : ",") + ("{\"name\":" + json(variant.name).dump()) +
                ",\"pipeline\":" + variant.resolved + "}";
  }
  return "{" + kept_table().members_json(experiment) + ",\"variants\":[" + variants + "]}";
}

Experiment read_experiment_json(const std::string& text, const std::string& file) {
  std::vector<Fault> faults;
  const json parsed = json::parse(text, nullptr, false);
  if (!parsed.is_object()) throw InputError(file, "/experiment", "expected an object");
  if (parsed.contains("variants") && parsed["variants"].size() > kMostVariants) {
    throw InputError(file, "/experiment/variants",
                     "expected at most " + std::to_string(kMostVariants) + " variants");
  }
  params::MemberOrigins origins;
  json keys = with_present_names(parsed, file, faults, origins);
  // Earlier versions wrote the number over all levels of a sweep. The store has the number too.
  if (keys.contains("starts") && keys["starts"].is_object()) keys["starts"].erase("trials");
  Experiment experiment =
      kept_table().read(Node(keys, file, faults, origins), {"variants"}, UnbuiltStages());
  if (!faults.empty()) throw InputError(faults);
  experiment.file = file;
  return experiment;
}

}  // namespace croon::experiments

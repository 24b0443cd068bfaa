#include "experiments/file/start_rule.hpp"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "framework/base/error.hpp"

namespace croon::experiments {
namespace {

using params::Node;
using params::value_json;

/// The keys of "starts" where there is a file.
struct FileKeys {
  std::string file;
  int trials = 0;
};

const params::Table<FileKeys>& file_table() {
  static const params::Table<FileKeys> table = {
      params::text("file", &FileKeys::file, "A file of starts."),
      params::integer("trials", &FileKeys::trials, {1, kMaxTrials}, "The first so many of them."),
  };
  return table;
}

StartRule read_file_rule(const Node& node, const Catalogue& catalogue) {
  for (const char* key : {"around", "rotation_deg", "translation_m", "sweep"}) {
    if (node.has(key)) {
      node.member(key).fault("expected no key but \"trials\" beside \"file\", found \"" +
                             std::string(key) + "\"");
    }
  }
  const FileKeys keys =
      file_table().read(node, {"around", "rotation_deg", "translation_m", "sweep"}, catalogue);
  StartRule rule;
  rule.file = keys.file;
  rule.trials = keys.trials;
  return rule;
}

/// The ends of the ramp, `key` of `node`; notes a fault where they do not rise.
void read_ends(const Node& node, const std::string& key, const std::vector<double>& ends,
               Sweep& sweep) {
  if (ends.size() != 2 || ends[0] >= ends[1]) {
    return node.member(key).expected("two numbers, the smaller first");
  }
  sweep.first = ends[0];
  sweep.last = ends[1];
}

Sweep read_sweep(const Node& starts, const Catalogue& catalogue) {
  const Node node = starts.member("sweep");
  Sweep sweep;
  if (!node.is_object()) return sweep;
  const std::size_t faults_before = node.fault_count();
  const SweepKeys keys = sweep_table().read(node, {}, catalogue);
  if (node.fault_count() > faults_before) return sweep;
  if (node.has("rotation_deg") == node.has("translation_m")) {
    node.expected("one of \"rotation_deg\" and \"translation_m\"");
    return sweep;
  }
  const bool is_rotation = node.has("rotation_deg");
  const char* const key = is_rotation ? "rotation_deg" : "translation_m";
  sweep.of = is_rotation ? SweepOf::rotation : SweepOf::translation;
  sweep.levels = keys.levels;
  read_ends(node, key, is_rotation ? keys.rotation_deg : keys.translation_m, sweep);
  if (starts.has(key)) {
    starts.member(key).fault("expected no \"" + std::string(key) +
                             "\" beside a sweep of it, found one");
  }
  return sweep;
}

StartRule read_drawn_rule(const Node& node, const Catalogue& catalogue) {
  const StartKeys keys = start_table().read(node, {"sweep", "file"}, catalogue);
  StartRule rule;
  const auto centre = std::find(kStartCentres.begin(), kStartCentres.end(), keys.around);
  rule.around = static_cast<StartCentre>(centre - kStartCentres.begin());
  rule.rotation_deg = keys.rotation_deg;
  rule.translation_m = keys.translation_m;
  if (node.has("sweep")) rule.sweep = read_sweep(node, catalogue);
  try {
    set_trials(rule, keys.trials);
  } catch (const InputError& error) {
    const Node place = node.has("trials") ? node.member("trials") : node;
    place.fault(error.faults().front().message);
  }
  return rule;
}

const char* swept_key(const Sweep& sweep) {
  return sweep.of == SweepOf::rotation ? "rotation_deg" : "translation_m";
}

}  // namespace

StartRule read_start_rule(const Node& root, const Catalogue& catalogue) {
  if (!root.has("starts") || !root.member("starts").is_object()) return {};
  const Node node = root.member("starts");
  return node.has("file") ? read_file_rule(node, catalogue) : read_drawn_rule(node, catalogue);
}

void set_trials(StartRule& rule, int trials) {
  const int levels = rule.sweep ? rule.sweep->levels : 1;
  if (trials > kMaxTrials / levels) {
    const std::string per_level =
        rule.sweep ? " of each of the " + std::to_string(levels) + " levels of the sweep" : "";
    throw InputError("", "--trials",
                     "expected a whole number from 1 to " + std::to_string(kMaxTrials / levels) +
                         per_level + ", found " + std::to_string(trials));
  }
  if (trials > 0) rule.trials = trials * levels;
}

std::string starts_json(const StartRule& rule) {
  if (!rule.file.empty()) {
    const std::string sha256 = rule.table ? rule.table->sha256 : "";
    return R"({"file":)" + value_json(rule.file) + R"(,"sha256":)" + value_json(sha256) + "}";
  }
  std::string text = R"({"around":")" + std::string(centre_name(rule.around)) + "\"";
  const auto add_range = [&](SweepOf of, const char* key, double value) {
    if (rule.sweep && rule.sweep->of == of) return;
    text += ",\"" + std::string(key) + "\":" + value_json(value);
  };
  add_range(SweepOf::rotation, "rotation_deg", rule.rotation_deg);
  add_range(SweepOf::translation, "translation_m", rule.translation_m);
  if (rule.sweep) {
    text += R"(,"sweep":{")" + std::string(swept_key(*rule.sweep)) +
            "\":" + value_json(std::vector{rule.sweep->first, rule.sweep->last}) +
            ",\"levels\":" + value_json(rule.sweep->levels) + "}";
  }
  return text + "}";
}

std::string deciding_starts_json(const StartRule& rule) {
  StartRule nameless = rule;
  if (rule.table) nameless.file = "*";
  return starts_json(nameless);
}

std::optional<Sweep> sweep_of_json(const nlohmann::json& starts) {
  const auto found = starts.find("sweep");
  if (found == starts.end()) return std::nullopt;
  Sweep sweep;
  sweep.of = found->contains("rotation_deg") ? SweepOf::rotation : SweepOf::translation;
  const nlohmann::json& ends = found->at(swept_key(sweep));
  sweep.first = ends.at(0);
  sweep.last = ends.at(1);
  sweep.levels = found->at("levels");
  return sweep;
}

const char* centre_name(StartCentre centre) {
  return kStartCentres.at(static_cast<std::size_t>(centre)).c_str();
}

}  // namespace croon::experiments

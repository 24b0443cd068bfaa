#include "experiments/file/start_rule.hpp"

#include "framework/base/error.hpp"
#include "framework/geometry/length_bound.hpp"
#include "framework/params/group.hpp"

namespace croon::experiments {
namespace {

using params::Node;
using params::Parameter;

/// The row of the range [min, max] of `of`. A sweep has one of two such keys.
Parameter<Sweep> swept_range(const std::string& key, SweepOf of, double limit,
                             const std::string& sentence) {
  params::ParameterDoc doc{key,     params::ParameterType::interval, "", {0.0, limit}, {}, "",
                           sentence};
  doc.is_optional = true;
  const auto read = [doc, of](Sweep& sweep, const Node& node, const params::StageBuilder&) {
    const std::size_t faults_before = node.fault_count();
    std::array<double, 2> ends = {};
    params::read_value(node, doc, ends);
    if (node.fault_count() > faults_before) return;
    if (ends[0] == ends[1]) return node.expected("two different numbers, the smaller first");
    sweep.of = of;
    sweep.first = ends[0];
    sweep.last = ends[1];
  };
  const auto to_json = [of](const Sweep& sweep) {
    return sweep.of == of ? params::value_json(std::array<double, 2>{sweep.first, sweep.last})
                          : std::string();
  };
  return {doc, read, to_json, false};
}

const params::Table<Sweep>& sweep_table() {
  static const params::Table<Sweep> table = [] {
    params::Table<Sweep> rows = {
        swept_range("rotation_deg", SweepOf::rotation, 180.0,
                    "Minimum and maximum angle, about an axis uniform on the sphere."),
        swept_range("translation_m", SweepOf::translation, kMaxCoordinate_m,
                    "Minimum and maximum length, along a direction uniform on the sphere."),
        params::integer("levels", &Sweep::levels, {2, 1000},
                        "Number of sizes from minimum to maximum, in equal steps."),
    };
    params::KeyRule one_range;
    one_range.one_of = {"rotation_deg", "translation_m"};
    return rows.rule(one_range);
  }();
  return table;
}

/// The number of trials, optional with a file of starts.
Parameter<StartRule> trials_row() {
  Parameter<StartRule> row = params::integer(
      "trials", &StartRule::trials, {1, kMaxTrials},
      "Number of starts per variant, scene and sensor: per level in a sweep; from a file, the "
      "first N (default: all).");
  row.json = [](const StartRule& rule) {
    return rule.trials == 0 ? std::string() : params::value_json(rule.trials);
  };
  return row;
}

int level_count(const StartRule& rule) { return rule.sweep ? rule.sweep->levels : 1; }

/// Why the rule has too many trials; empty if it does not.
std::string excess_text(const StartRule& rule) {
  if (rule.is_none && rule.trials > 1) {
    return "expected 1, because trials without an initial guess (\"starts\": \"none\") do not "
           "differ, found " +
           std::to_string(rule.trials);
  }
  const int levels = level_count(rule);
  if (rule.trials <= kMaxTrials / levels) return "";
  const std::string per_level =
      rule.sweep ? " of each of the " + std::to_string(levels) + " levels of the sweep" : "";
  return "expected a whole number from 1 to " + std::to_string(kMaxTrials / levels) + per_level +
         ", found " + std::to_string(rule.trials);
}

void finish_reading(StartRule& rule, const Node& node) {
  if (!rule.file.empty() && !node.has("trials")) rule.trials = 0;
  const std::string excess = excess_text(rule);
  if (excess.empty()) return;
  (node.has("trials") ? node.member("trials") : node).fault(excess);
}

/// The rule against a range that is also swept.
params::KeyRule swept(const std::string& key) {
  return {"sweep/" + key, {}, false, {}, {key}, "no \"" + key + "\" beside a sweep of it"};
}

params::Table<StartRule> make_start_table() {
  using P = StartRule;
  params::Table<P> table = {
      params::choice("around", &P::around, kStartCentres,
                     "Pose around which initial guesses are drawn."),
      params::per_axis(
          "rotation_deg", &P::rotation_deg, {0.0, 180.0},
          "Half range of roll, pitch and yaw, or one for each; 180 is any rotation, uniform "
          "on SO(3)."),
      params::per_axis("translation_m", &P::translation_m, {0.0, kMaxCoordinate_m},
                       "Half range of x, y and z in reference axes, or one for each."),
      trials_row(),
      params::optional_group("sweep", &P::sweep, sweep_table(),
                             "Starts with increasing perturbation, to measure the basin of "
                             "convergence."),
      params::optional(params::text("file", &P::file,
                                    "File of starts, in the format of croon starts: below the data "
                                    "root, else relative to the experiment file.")),
      params::optional(
          params::text("sha256", &P::sha256, "Required digest of the file of starts.")),
  };
  table.rule({"file",
              {},
              false,
              {},
              {"around", "rotation_deg", "translation_m", "sweep"},
              "no key but \"trials\" beside \"file\""});
  table.rule({"file", {}, true, {}, {"sha256"}, "no key \"sha256\" without \"file\""});
  table.rule(swept("rotation_deg")).rule(swept("translation_m"));
  return table.finish(finish_reading);
}

}  // namespace

const params::Table<StartRule>& start_table() {
  static const params::Table<StartRule> table = make_start_table();
  return table;
}

std::string starts_json(const StartRule& rule) {
  return rule.is_none ? params::value_json(std::string(kNoStarts)) : start_table().json(rule);
}

int total_trials(const StartRule& rule) { return rule.trials * level_count(rule); }

void set_trials(StartRule& rule, int trials) {
  StartRule changed = rule;
  if (trials > 0) changed.trials = trials;
  const std::string excess = excess_text(changed);
  if (!excess.empty()) throw InputError("", "--trials", excess);
  rule = changed;
}

std::string deciding_starts_json(const StartRule& rule) {
  StartRule nameless = rule;
  if (!rule.file.empty()) nameless.file = "*";
  nameless.trials = 0;
  return starts_json(nameless);
}

}  // namespace croon::experiments

#include "experiments/file/claims.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/file/measures.hpp"
#include "experiments/file/statistics.hpp"
#include "framework/params/choice.hpp"
#include "framework/params/group.hpp"
#include "framework/params/values.hpp"

namespace croon::experiments {
namespace {

using params::Node;
using params::optional;
using params::Parameter;
using params::Table;

const std::vector<std::string> kShares = {kSuccess, kAgreement, kScenes};

const params::Words<Over> kOver = {{"successful", Over::successful}, {"usable", Over::usable}};

/// How the bands of a table of claims are computed from its values.
enum class BandRule {
  no_worse,    ///< At most as far from zero as the source's value plus its uncertainty.
  around_zero  ///< Within a half width of zero, given in the file for each measure.
};

struct TableBand {
  BandRule rule = BandRule::no_worse;
  int samples = 0;
  int decimals = 4;
  std::vector<double> half_width;
};

/// The values of one sensor: a list for each statistic, with one number per measure of the table.
struct TableValues {
  std::array<std::vector<double>, kStatistics.size()> by_statistic;
};

/// An element of "claims".
struct ClaimKeys : Claim {
  std::vector<std::size_t> measures;
  std::vector<std::pair<std::string, TableValues>> values;
  TableBand band_rule;
};

const Table<Claim>& claim_table() {
  static const Table<Claim> table = [] {
    using P = Claim;
    Table<P> rows = {
        params::text("claim", &P::claim, "What the number means, in words."),
        params::text("source", &P::source, "Source of the number, e.g. \"paper, Table 1\"."),
        optional(params::text("variant", &P::variant, "Variant; default: the first.")),
        optional(params::text("sensor", &P::sensor, "Sensor; default: all sensors together.")),
        optional(params::choice("measure", &P::measure, measure_names(),
                                "Measure, in deg or m; none for shares.")),
        optional(params::choice("statistic", &P::statistic, claim_statistics(),
                                "Statistic; success, agreement and scenes are shares in %.")),
        params::choice(
            "over", &P::over, kOver,
            "Trials of a statistic of errors: the successful ones (without ground truth: those "
            "that agree), or all usable ones, which finished and were not rejected."),
        optional(params::number("value", &P::value, {}, "Number in the source, in deg, m or %.")),
        optional(params::interval("band", &P::band, {}, "Minimum and maximum of our number.")),
        optional(params::text("why", &P::why, "Why ours may differ.")),
    };
    rows.rule({"statistic", kShares, true, {"measure"}, {}});
    std::vector<std::string> of_all_trials = kShares;
    of_all_trials.insert(of_all_trials.end(), {kWithinSceneStd, kAcrossScenesStd});
    rows.rule({"statistic",
               of_all_trials,
               false,
               {},
               {"over"},
               "no choice of trials for a share or a spread"});
    return rows.rule(
        {"statistic", kShares, false, {}, {"measure"}, "no measure of a share of the trials"});
  }();
  return table;
}

Table<TableBand> band_table() {
  using P = TableBand;
  Table<P> table = {
      params::choice(
          "rule", &P::rule,
          params::Words<BandRule>{{"no_worse", BandRule::no_worse},
                                  {"around_zero", BandRule::around_zero}},
          "no_worse: a mean is at most as far from zero as the value plus twice its standard "
          "error, any other statistic is at most the value; around_zero: within half_width of "
          "zero."),
      params::integer("samples", &P::samples, {0, 1e9},
                      "Number of errors behind the source's values, for the standard error."),
      params::integer(
          "decimals", &P::decimals, {0, 9},
          "Number of decimals, as in the source, to which bands of means are rounded up."),
      optional(params::numbers("half_width", &P::half_width, {0.0, 1e9},
                               "Half width of the band of each measure.")),
  };
  table.rule({"rule",
              {"around_zero"},
              false,
              {"half_width"},
              {"samples", "decimals"},
              "neither \"samples\" nor \"decimals\" here"});
  table.rule({"rule", {"around_zero"}, true, {}, {"half_width"}, "no half width of another rule"});
  return table;
}

/// The row of one statistic in a table of values.
Parameter<TableValues> values_row(std::size_t statistic) {
  const std::string name = kStatistics[statistic].name;
  const params::ParameterDoc doc{name, params::ParameterType::numbers,     "[]", {}, {},
                                 "",   "The " + name + " of each measure."};
  return optional(params::value_row<TableValues>(
      doc, [=](auto& values) -> auto& { return values.by_statistic[statistic]; }));
}

Table<TableValues> values_table() {
  Table<TableValues> table;
  for (std::size_t k = 0; k < kStatistics.size(); ++k) table.add(values_row(k));
  return table;
}

Parameter<ClaimKeys> measures_row() {
  params::ParameterDoc doc{"measures", params::ParameterType::choices,      "", {}, measure_names(),
                           "",         "Measures of the values in a table."};
  doc.is_optional = true;
  return {doc,
          [](ClaimKeys& keys, const Node& node, const params::StageBuilder&) {
            keys.measures = params::read_words(node, measure_names());
          },
          [](const ClaimKeys&) { return std::string(); }, false};
}

const Table<ClaimKeys>& claim_keys_table() {
  static const Table<ClaimKeys> table = [] {
    using P = ClaimKeys;
    Table<P> rows;
    rows.inherit(claim_table());
    rows.add(measures_row());
    rows.add(optional(params::map("values", &P::values, values_table(), "a sensor's name, or all",
                                  "A table of claims: for each sensor the statistics, each a list "
                                  "with one number per measure.")));
    rows.add(optional(params::group("band_rule", &P::band_rule, band_table(), {},
                                    "How the bands of a table are computed from its values.")));
    const std::vector<std::string> of_one = {"sensor", "measure", "statistic", "value", "band"};
    const std::vector<std::string> of_table = {"measures", "band_rule"};
    rows.rule(
        {"values", {}, false, of_table, of_one, "no key of a single claim beside \"values\""});
    return rows.rule({"values",
                      {},
                      true,
                      {"statistic", "value", "band"},
                      of_table,
                      "no key of a table of claims without \"values\""});
  }();
  return table;
}

/// Notes a fault for each list whose length is not the number of measures.
void check_sizes(const ClaimKeys& keys, const Node& node) {
  const std::string expected =
      "one number for each of the " + std::to_string(keys.measures.size()) + " measures";
  const auto check = [&](const std::vector<double>& list, const Node& at) {
    if (list.size() != keys.measures.size()) at.expected(expected);
  };
  for (const auto& [sensor, values] : keys.values) {
    const Node at = node.member("values").member(sensor);
    for (std::size_t k = 0; k < kStatistics.size(); ++k) {
      const std::string name = kStatistics[k].name;
      if (at.has(name)) check(values.by_statistic[k], at.member(name));
    }
  }
  if (keys.band_rule.rule == BandRule::around_zero) {
    check(keys.band_rule.half_width, node.member("band_rule").member("half_width"));
  }
}

/// The half width of the band of a mean: |value| plus twice its standard error, rounded up.
double half_width_of_mean(double value, double std, const TableBand& band) {
  double scale = 1.0;
  for (int i = 0; i < band.decimals; ++i) scale *= 10.0;
  const double half_width = std::abs(value) + 2.0 * std / std::sqrt(band.samples);
  // Subtracting 1e-6 prevents a half width that already has this many decimals from being rounded
  // up.
  return std::ceil(half_width * scale - 1e-6) / scale;
}

/// Expands a table of claims.
class ClaimExpander {
 public:
  ClaimExpander(const ClaimKeys& keys, const Node& node) : keys_(keys), node_(node) {}

  std::vector<Claim> expand() {
    for (const auto& [sensor, values] : keys_.values) {
      const Node at = node_.member("values").member(sensor);
      for (std::size_t column = 0; column < keys_.measures.size(); ++column) {
        for (std::size_t k = 0; k < kStatistics.size(); ++k) {
          if (values.by_statistic[k].empty()) continue;
          add(sensor, values, column, k, at);
        }
      }
    }
    return std::move(claims_);
  }

 private:
  void add(const std::string& sensor, const TableValues& values, std::size_t column,
           std::size_t statistic, const Node& at) {
    Claim claim = keys_;
    claim.sensor = sensor == kAllSensors ? "" : sensor;
    claim.measure = kMeasures[keys_.measures[column]].name;
    claim.statistic = kStatistics[statistic].name;
    claim.claim += ", " + (claim.sensor.empty() ? std::string("all sensors") : sensor) + ": " +
                   claim.statistic + " of " + claim.measure;
    if (claim.over == Over::usable) claim.claim += ", all usable trials";
    claim.value = values.by_statistic[statistic][column];
    claim.sensor_file = at.file();
    claim.sensor_pointer = claim.sensor.empty() ? "" : at.pointer();
    claim.band = band_of(claim, values, column, at);
    claims_.push_back(std::move(claim));
  }

  std::array<double, 2> band_of(const Claim& claim, const TableValues& values, std::size_t column,
                                const Node& at) const {
    const TableBand& band = keys_.band_rule;
    if (band.rule == BandRule::around_zero) {
      return {-band.half_width[column], band.half_width[column]};
    }
    if (!kStatistics[statistic_index(claim.statistic)].is_signed) {
      if (claim.value < 0.0) {
        at.member(claim.statistic)
            .fault("expected numbers of at least 0, found " + params::value_json(claim.value));
      }
      return {0.0, claim.value};
    }
    const std::vector<double>& stds = values.by_statistic[statistic_index("std")];
    if (claim.statistic != "mean" || stds.empty() || band.samples == 0) {
      at.member(claim.statistic)
          .fault(
              "expected a mean with \"std\" beside it and \"samples\" in \"band_rule\": the rule "
              "no_worse needs the standard error");
      return claim.band;
    }
    const double half_width = half_width_of_mean(claim.value, stds[column], band);
    if (!std::isfinite(half_width)) {
      at.member(claim.statistic).fault("expected numbers whose band is finite");
    }
    return {-half_width, half_width};
  }

  const ClaimKeys& keys_;
  const Node& node_;
  std::vector<Claim> claims_;
};

}  // namespace

const std::vector<std::string>& claim_statistics() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = kShares;
    const std::vector<std::string> statistics = statistic_names();
    all.insert(all.end(), statistics.begin(), statistics.end());
    all.insert(all.end(), {kWithinSceneStd, kAcrossScenesStd});
    return all;
  }();
  return names;
}

const std::string& word_of_over(Over over) { return params::word_of(kOver, over); }

bool is_share(const std::string& statistic) {
  return std::find(kShares.begin(), kShares.end(), statistic) != kShares.end();
}

const params::ParameterDoc& claims_doc() {
  static const params::ParameterDoc doc = [] {
    params::ParameterDoc claims = params::object_doc(
        "claims", params::ParameterType::list, claim_keys_table(),
        "Numbers of a source, and the bands in which ours must lie; they do not affect trials.");
    claims.default_json = "[]";
    return claims;
  }();
  return doc;
}

std::vector<Claim> read_claims(const Node& node) {
  std::vector<Claim> claims;
  if (!node.is_array()) return claims;
  if (node.value().size() > kMaxClaims) {
    node.fault("expected at most " + std::to_string(kMaxClaims) + " claims, found " +
               std::to_string(node.value().size()));
    return claims;
  }
  params::for_each_element(node, [&](const Node& element) {
    if (!element.is_object()) return;
    const std::size_t faults_before = element.fault_count();
    ClaimKeys keys = claim_keys_table().read(element, {}, params::NoStages());
    if (element.fault_count() > faults_before) return;
    if (keys.values.empty()) {
      keys.sensor_file = element.file();
      keys.sensor_pointer = keys.sensor.empty() ? "" : element.pointer() + "/sensor";
      claims.push_back(keys);
      return;
    }
    check_sizes(keys, element);
    if (element.fault_count() > faults_before) return;
    const std::vector<Claim> expanded = ClaimExpander(keys, element).expand();
    claims.insert(claims.end(), expanded.begin(), expanded.end());
  });
  if (claims.size() > kMaxClaims) {
    node.fault("expected at most " + std::to_string(kMaxClaims) + " claims, found " +
               std::to_string(claims.size()) + " with all values of tables");
  }
  return claims;
}

std::string claims_json(const std::vector<Claim>& claims) {
  return params::list_json(claims, [](const Claim& claim) { return claim_table().json(claim); });
}

const Table<Quoted>& quoted_table() {
  using P = Quoted;
  const auto error = [](const char* key, double P::*value, const std::string& dof) {
    return params::required(params::number(key, value, {}, "Error in " + dof + "."));
  };
  static const Table<P> table = {
      params::text("method", &P::method, "Name of the method."),
      params::text("source", &P::source, "Source of the numbers."),
      params::required(params::choice("statistic", &P::statistic, statistic_names(),
                                      "Statistic of the numbers.")),
      error("pitch_deg", &P::pitch_deg, "pitch"),
      error("roll_deg", &P::roll_deg, "roll"),
      error("yaw_deg", &P::yaw_deg, "yaw"),
      error("x_m", &P::x_m, "x"),
      error("y_m", &P::y_m, "y"),
      error("z_m", &P::z_m, "z"),
  };
  return table;
}

}  // namespace croon::experiments

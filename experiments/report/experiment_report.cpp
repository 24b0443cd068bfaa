#include "experiments/report/experiment_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/report/build_text.hpp"
#include "experiments/report/export.hpp"
#include "experiments/report/figures.hpp"
#include "experiments/report/result_sections.hpp"
#include "experiments/report/result_tables.hpp"
#include "experiments/report/rig_view_blocks.hpp"
#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"
#include "framework/calibration/fit_check.hpp"

namespace croon::experiments {
namespace {

std::string percent_text(const Share& share) {
  std::string text = fixed_number(100.0 * share.ratio, 1) + " %";
  if (share.interval) {
    text += " [" + fixed_number(100.0 * share.interval->low, 1) + ", " +
            fixed_number(100.0 * share.interval->high, 1) + "]";
  }
  return text;
}

/// "98.3 % [95.1, 99.4] of 144 trials are within 0.5 deg and 0.1 m of ground truth".
std::string variant_sentence(const Summary& summary, const std::string& variant) {
  const TrialSummary all = pooled_counts(scenes_of(rows_of(summary, variant)));
  const Share& share = main_share(all);
  const std::string what = lacks_truth(all)
                               ? " agree with the consensus of their scene"
                               : " are within " + bounds_text(summary.bounds) + "ground truth";
  return variant + ": " + percent_text(share) + " of " +
         counted(static_cast<std::size_t>(share.trials), "trial") + what;
}

std::string lead_of(const Results& results) {
  const std::vector<std::string> variants = variants_of(results.summary);
  if (variants.empty()) return "There are no trials.";
  std::string best = variants.front();
  const auto ratio = [&](const std::string& variant) {
    return main_share(pooled_counts(scenes_of(rows_of(results.summary, variant)))).ratio;
  };
  for (const std::string& variant : variants) {
    if (ratio(variant) > ratio(best)) best = variant;
  }
  const std::string sentence = variant_sentence(results.summary, best) + ".";
  return variants.size() == 1
             ? sentence
             : "Best of " + std::to_string(variants.size()) + " variants: " + sentence;
}

/// The variants with intervals, the best values and significance marks.
TableBlock variant_table(const Results& results) {
  ExportCaption caption;
  caption.name = results.name;
  caption.commit = short_commit(results.commit);
  caption.seed = results.seed;
  caption.scenes = results.scenes;
  caption.starts = results.trials;
  caption.found = results.records.size();
  caption.planned = results.planned;
  caption.scenes_per_trial = results.scenes_per_trial;
  const ExportTable table = export_table(results.summary, caption);
  std::string sentences;
  for (const std::string& sentence : caption_sentences(table)) sentences += sentence + " ";
  View view{{{"variant"}, {"sensor"}, {"scenes"}, {"trials"}}, 2};
  for (const std::string& share : share_names(table.table)) {
    view.columns.push_back({share + ", %", "<" + share + "_percent>"});
    view.columns.push_back(
        {"95 % interval", "[<" + share + "_low_percent>, <" + share + "_high_percent>]"});
  }
  view.columns.push_back(
      {"rotation, deg (median, p95)", "<rotation_median_deg>, <rotation_p95_deg>"});
  view.columns.push_back(
      {"translation, m (median, p95)", "<translation_median_m>, <translation_p95_m>"});
  return {sentences, table.table, view};
}

Section result_section(const Results& results) {
  Section section{"result", "Result", {}};
  if (!results.description.empty()) {
    section.blocks.emplace_back(Paragraph{"Question: " + results.description});
  }
  if (results.records.size() < results.planned) {
    section.blocks.emplace_back(Paragraph{std::to_string(results.records.size()) + " of " +
                                              std::to_string(results.planned) +
                                              " planned trials are stored.",
                                          Tone::warning});
  }
  section.blocks.emplace_back(variant_table(results));
  return section;
}

Section chart_section(const Results& results) {
  Section section{"charts", "Charts", {}};
  for (const Figure& figure : figures()) {
    try {
      if (std::optional<Drawing> drawing = figure.draw(results, {})) {
        section.blocks.emplace_back(Chart{"", std::move(*drawing)});
      }
    } catch (const InputError& error) {
      section.blocks.emplace_back(
          Paragraph{std::string(figure.name) + ": " + error.faults().front().message, Tone::note});
    }
  }
  return section;
}

/// The medians of the numbers that steps report, such as costs and ratios, in pipeline order.
Section step_section(const Results& results) {
  using D = DiagnosticSummary;
  Columns<D> columns;
  columns.add({"variant"}, &D::variant)
      .add({"step"}, &D::step)
      .add({"number"}, &D::name)
      .add({"trials"}, &D::trials)
      .add({"median", "", "", kAllDigits},
           [](const D& row) -> std::optional<double> { return row.median; });
  const Table table = columns.table(results.diagnostics);
  return {"steps",
          "Numbers along the pipeline",
          {TableBlock{"Medians over trials of the numbers that steps report.", table,
                      whole_view(table, 3)}}};
}

std::string trial_text(const TrialRecord& record) {
  std::string text = record.id.variant + ", scene " + record.id.scene + ", sensor " +
                     record.id.sensor + ", trial " + std::to_string(record.id.trial) + ": " +
                     status_name(record.status);
  if (record.error) {
    text += ", " + fixed_number(deg_from_rad(record.error->rotation_rad), 3) + " deg and " +
            fixed_number(1e3 * record.error->translation_m, 1) + " mm from ground truth";
  }
  return text + (record.reason.empty() ? "." : ". " + record.reason);
}

/// The numbers that the steps of a trial, one of `results.records`, reported.
TableBlock trial_numbers(const Results& results, const TrialRecord& record) {
  const auto index = static_cast<std::size_t>(&record - results.records.data());
  std::vector<StepNumber> numbers;
  for (const StepNumber& number : results.steps.numbers) {
    if (number.record == index) numbers.push_back(number);
  }
  Columns<StepNumber> columns;
  columns.add({"step"}, [&](const StepNumber& number) { return results.steps.names[number.step]; })
      .add({"number"}, [&](const StepNumber& number) { return results.steps.names[number.name]; })
      .add({"value", "", "", kAllDigits}, &StepNumber::value);
  const Table table = columns.table(numbers);
  return {"Numbers that the steps of this trial reported, in pipeline order.", table,
          whole_view(table, 2)};
}

constexpr const char* kHowToAdd =
    "To add the clouds of another stored trial, name it: croon report DIR --trial "
    "\"VARIANT/SCENE/SENSOR/NUMBER\".";

Section trial_section(const Results& results, const std::vector<TrialView>& views,
                      const std::string& without_views) {
  Section section{"trials", "Trials to look at", {}};
  if (views.empty()) section.blocks.emplace_back(Paragraph{without_views, Tone::note});
  if (!results.records.empty()) section.blocks.emplace_back(Paragraph{kHowToAdd});
  std::size_t number = 0;
  for (const TrialView& trial : views) {
    Section inner{"trial-" + std::to_string(++number), trial.why, {}};
    inner.blocks.emplace_back(Paragraph{trial_text(*trial.record)});
    const ViewedSensor& sensor = trial.view.sensors.back();
    const bool has_result = trial.record->T_reference_sensor.has_value();
    // Without a result, the fit is that of ground truth or of the initial guess.
    if (sensor.refit && has_result) {
      inner.blocks.emplace_back(Paragraph{
          fit_sentence(sensor.refit), is_contradicted(sensor.refit) ? Tone::warning : Tone::plain});
    }
    inner.blocks.emplace_back(cloud_view_block(
        trial.view, "Scene " + trial.view.scene +
                        (has_result ? " at the initial guess and at the result."
                                    : " at the initial guess, and at ground truth if it is known: "
                                      "the trial has no result.")));
    if (FigureRow row = close_up_row(trial.view); !row.figures.empty()) {
      inner.blocks.emplace_back(std::move(row));
    }
    for (const Chart& chart : trial.charts) inner.blocks.emplace_back(chart);
    TableBlock numbers = trial_numbers(results, *trial.record);
    if (!numbers.table.rows.empty()) inner.blocks.emplace_back(std::move(numbers));
    section.sections.push_back(std::move(inner));
  }
  return section;
}

Section provenance_section(const Results& results) {
  Facts facts{{{"experiment", results.name},
               {"seed", std::to_string(results.seed)},
               {"starts per variant, scene and sensor", std::to_string(results.trials)}}};
  for (const Build& build : results.builds) {
    facts.facts.emplace_back(
        "croon", build.version + ", commit " + build.commit + ", program " + build.program_sha256);
  }
  const auto json = nlohmann::ordered_json::parse(results.manifest);
  for (const auto& [name, digest] : json.at("provenance").items()) {
    facts.facts.emplace_back("digest of " + name, digest.get<std::string>());
  }
  return {"provenance", "Provenance", {facts}};
}

}  // namespace

Document experiment_report(const Results& results, const std::vector<TrialView>& views,
                           const std::string& without_views) {
  Document document{"Experiment " + results.name, lead_of(results), {result_section(results)}};
  document.sections.push_back(
      {"pipeline",
       "Pipelines",
       {Chart{"The steps of each variant; * marks steps that differ from those of the first.",
              pipeline_chart(results.manifest)}}});
  document.sections.push_back(chart_section(results));
  document.sections.push_back(trial_section(results, views, without_views));
  for (Section& section : result_sections(results)) document.sections.push_back(std::move(section));
  if (!results.diagnostics.empty()) document.sections.push_back(step_section(results));
  document.sections.push_back(provenance_section(results));
  return document;
}

}  // namespace croon::experiments

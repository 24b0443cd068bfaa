#include "experiments/file/experiment_keys.hpp"

#include <nlohmann/json.hpp>

namespace croon::experiments {
namespace {

using params::json_value;
using params::list;
using params::optional;
using params::Table;
using params::text;

Table<SuccessBounds> success_table() {
  return {
      params::number("rotation_deg", &SuccessBounds::rotation_deg, {0.0, 180.0},
                     "Maximum angle between the estimate and ground truth."),
      params::number("translation_m", &SuccessBounds::translation_m, {0.0, 1e6},
                     "Maximum distance between the estimate and ground truth."),
  };
}

Table<Insertion> insertion_table() {
  Table<Insertion> table = {
      optional(text("before", &Insertion::before, "Name of the following step.")),
      optional(text("after", &Insertion::after, "Name of the preceding step.")),
      params::required(json_value("step", &Insertion::step, kStepDefinition, "Step to insert.")),
  };
  params::KeyRule one_anchor;
  one_anchor.one_of = {"before", "after"};
  return table.rule(one_anchor);
}

Table<VariantKeys> variant_table() {
  using P = VariantKeys;
  return {
      params::name("name", &P::name, kVariantName,
                   "Name of the variant; \"base\" is the base pipeline."),
      optional(text("poses", &P::poses,
                    "File of poses from another program, in the format of croon starts, with or "
                    "without the column trial: they are judged like results. A pipeline of the "
                    "variant starts from them.")),
      json_value("pipeline", &P::pipeline, kPipelineDefinition,
                 "Complete pipeline that replaces the base pipeline."),
      list("insert", &P::insert, insertion_table(), "Steps to insert, in order."),
      params::texts("remove", &P::remove, "Names of steps to remove."),
      json_value("replace", &P::replace, kReplacementsDefinition,
                 "STEP or STEP.SLOT, and its replacement."),
  };
}

/// An object for start_table, or kNoStarts.
params::Parameter<Experiment> starts_row() {
  params::Parameter<Experiment> row = params::group(
      "starts", &Experiment::starts, start_table(), {},
      "How initial guesses are drawn: a pose (R, t) moved to (R_d R, t + d); or a file of "
      "starts; or \"none\": "
      "one trial of each scene and sensor, from the identity, for methods that need no initial "
      "guess.");
  row.doc.choices = {kNoStarts};
  row.read = [read = row.read](Experiment& experiment, const params::Node& node,
                               const params::StageBuilder& builder) {
    if (node.has_members()) return read(experiment, node, builder);
    if (node.value() != kNoStarts) return node.expected("an object or \"none\"");
    experiment.starts.is_none = true;
    experiment.starts.trials = 1;
  };
  row.json = [](const Experiment& experiment) { return starts_json(experiment.starts); };
  return row;
}

}  // namespace

const Table<Experiment>& kept_table() {
  using P = Experiment;
  static const Table<P> table = {
      params::name("name", &P::name, kFolderName,
                   "The experiment's name; its results go to results/NAME."),
      params::free_text("description", &P::description, "Question that it answers."),
      params::required_slot("dataset", &P::dataset, "The scenes, the sensors and their clouds."),
      starts_row(),
      params::integer("seed", &P::seed,
                      "Seed of the experiment; starts depend on (seed, scene, sensor, trial)."),
      params::group("success", &P::success, success_table(), {},
                    "Maximum error of a successful trial."),
      params::integer(
          "scenes_per_trial", &P::scenes_per_trial, {1.0, 1000.0},
          "Number of scenes from which a trial calibrates the rig. Groups of scenes are "
          "drawn with the seed; no two groups share a scene."),
      params::boolean("loops", &P::loops,
                      "Also calibrates every pair of sensors in a scene to each other, to measure "
                      "the loop closure over the reference."),
      claims_row(&P::claims),
      list("quoted", &P::quoted, quoted_table(),
           "Published results of other methods, printed beside ours."),
  };
  return table;
}

const Table<Experiment>& workload_table() {
  static const Table<Experiment> table = [] {
    Table<Experiment> rows;
    for (params::Parameter<Experiment> row : kept_table().rows()) {
      row.doc.is_required = false;
      row.is_slot = false;  // A missing dataset is not built.
      rows.add(std::move(row));
    }
    return rows;
  }();
  return table;
}

const Table<ExperimentKeys>& experiment_table() {
  using P = ExperimentKeys;
  static const Table<P> table = [] {
    Table<P> rows = {json_value(
        "extends", &P::extends, kExtendsDefinition,
        "Another experiment file, relative to this one, whose keys are the defaults, or a "
        "list of files, in which keys of later files replace those of earlier ones. A key that is "
        "given here replaces the complete value.")};
    rows.inherit(kept_table());
    rows.add(params::required(json_value("pipeline", &P::pipeline, kPipelineDefinition,
                                         "The steps of the method, in order.")));
    rows.add(list("variants", &P::variant_keys, variant_table(),
                  "Other pipelines, described by their differences from the base pipeline."));
    return rows.add(json_value("grid", &P::grid, kGridDefinition,
                               "The product of these lists, on the base pipeline and each "
                               "variant."));
  }();
  return table;
}

std::string success_json(const SuccessBounds& bounds) { return success_table().json(bounds); }

}  // namespace croon::experiments

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
                     "Largest angle between the estimate and the truth."),
      params::number("translation_m", &SuccessBounds::translation_m, {0.0, 1e6},
                     "Largest distance between the estimate and the truth."),
  };
}

Table<Insertion> insertion_table() {
  Table<Insertion> table = {
      optional(text("before", &Insertion::before, "The name of the step that comes next.")),
      optional(text("after", &Insertion::after, "The name of the step that comes before it.")),
      params::required(
          json_value("step", &Insertion::step, kStepDefinition, "The step that is inserted.")),
  };
  params::KeyRule one_anchor;
  one_anchor.one_of = {"before", "after"};
  return table.rule(one_anchor);
}

Table<VariantKeys> variant_table() {
  using P = VariantKeys;
  return {
      params::name("name", &P::name, kVariantName,
                   "What the variant is called; \"base\" is the base pipeline."),
      optional(text("poses", &P::poses,
                    "A file of poses of another program, as croon starts writes it, with or "
                    "without the column trial: they are judged like results. A pipeline beside it "
                    "goes on from them.")),
      json_value("pipeline", &P::pipeline, kPipelineDefinition,
                 "A whole pipeline, in place of the base pipeline."),
      list("insert", &P::insert, insertion_table(),
           "Steps that are inserted, one after the other."),
      params::texts("remove", &P::remove, "The names of steps that are left out."),
      json_value("replace", &P::replace, kReplacementsDefinition,
                 "STEP or STEP.SLOT, and what stands there instead."),
  };
}

/// An object that start_table reads, or kNoStarts.
params::Parameter<Experiment> starts_row() {
  params::Parameter<Experiment> row = params::group(
      "starts", &Experiment::starts, start_table(), {},
      "How starts are drawn: a pose (R, t) moved to (R_d R, t + d); or a file of them; or "
      "\"none\": "
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
      params::free_text("description", &P::description, "The question it answers."),
      params::required_slot("dataset", &P::dataset, "The scenes, the sensors and their clouds."),
      starts_row(),
      params::integer("seed", &P::seed, "Every start is drawn from (seed, scene, sensor, trial)."),
      params::group("success", &P::success, success_table(), {},
                    "How near the truth a trial must end to count as a success."),
      params::integer("scenes_per_trial", &P::scenes_per_trial, {1.0, 1000.0},
                      "A trial calibrates the rig from a group of so many scenes. The seed draws "
                      "the groups, no two of which share a scene."),
      params::boolean("loops", &P::loops,
                      "Each two sensors of a scene are calibrated to each other too, which shows "
                      "how far the loop over the reference is from closing."),
      claims_row(&P::claims),
      list("quoted", &P::quoted, quoted_table(),
           "Rows of other methods, which are printed beside the row of this one."),
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
    Table<P> rows = {
        json_value("extends", &P::extends, kExtendsDefinition,
                   "Another experiment file, relative to this one, whose keys are defaults, or a "
                   "list of files, the later of which replace keys of the earlier. A key that is "
                   "given here replaces the whole key.")};
    rows.inherit(kept_table());
    rows.add(params::required(json_value("pipeline", &P::pipeline, kPipelineDefinition,
                                         "The steps of the method, in order.")));
    rows.add(list("variants", &P::variant_keys, variant_table(),
                  "Other pipelines, described by how they differ from the base pipeline."));
    return rows.add(json_value("grid", &P::grid, kGridDefinition,
                               "The product of these lists, on the base pipeline and each "
                               "variant."));
  }();
  return table;
}

std::string success_json(const SuccessBounds& bounds) {
  return params::object_json(success_table(), bounds);
}

}  // namespace croon::experiments

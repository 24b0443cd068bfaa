#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/file/experiment_keys.hpp"
#include "framework/base/text.hpp"
#include "framework/pipeline/patched_pipeline.hpp"
#include "framework/stage/given_motions.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;
using params::Node;

struct NamedPipeline {
  std::string name;
  PatchedPipeline pipeline;
  PosesFile poses = {};
};

void note(const Node& node, const std::string& why_not) {
  if (!why_not.empty()) node.fault(why_not);
}

/// Applies the changes `keys` of a variant to the pipeline `base`: steps are inserted, then
/// removed, then replaced. For poses from a file the base pipeline is empty. `node` is the
/// variant's.
PatchedPipeline changed(const PatchedPipeline& base, const VariantKeys& keys, const Node& node,
                        const Catalogue& catalogue) {
  PatchedPipeline pipeline = base;
  if (!keys.poses.empty()) pipeline.clear();
  if (keys.pipeline) pipeline = read_steps(*keys.pipeline);
  for (std::size_t i = 0; i < keys.insert.size(); ++i) {
    const Insertion& insertion = keys.insert[i];
    if (insertion.before.empty() == insertion.after.empty() || !insertion.step) continue;
    const bool is_after = insertion.before.empty();
    const Node at = node.member("insert").element(i).member(is_after ? "after" : "before");
    note(at, insert_step(pipeline, is_after ? insertion.after : insertion.before, is_after,
                         *insertion.step));
  }
  for (std::size_t i = 0; i < keys.remove.size(); ++i) {
    const Node at = node.member("remove").element(i);
    if (at.value().is_string()) note(at, remove_step(pipeline, keys.remove[i]));
  }
  if (!keys.replace || !keys.replace->is_object()) return pipeline;
  for (const auto& item : keys.replace->value().items()) {
    const Node value = keys.replace->member(item.key());
    note(value, replace_value(pipeline, item.key(), value, catalogue));
  }
  return pipeline;
}

/// The file of poses of the variant at `node`; notes a fault if `pipeline` already has a step with
/// the name of the step for poses.
PosesFile poses_of(const VariantKeys& keys, const Node& node, const PatchedPipeline& pipeline) {
  if (keys.poses.empty()) return {};
  for (const PatchedStep& step : pipeline) {
    if (step.name == kPosesStep) node.fault("two steps are called \"" + step.name + "\"");
  }
  const Node at = node.member("poses");
  return {keys.poses, at.file(), at.pointer()};
}

/// The base pipeline and the pipelines of the variants.
std::vector<NamedPipeline> read_pipelines(const ExperimentKeys& keys, const Node& root,
                                          const Catalogue& catalogue) {
  std::vector<NamedPipeline> pipelines = {{"base", read_steps(*keys.pipeline)}};
  if (keys.variant_keys.size() >= kMaxVariants) {
    root.member("variants")
        .fault("expected at most " + std::to_string(kMaxVariants - 1) +
               " variants beside the base, found " + std::to_string(keys.variant_keys.size()));
    return pipelines;
  }
  std::set<std::string> names = {"base"};
  for (std::size_t i = 0; i < keys.variant_keys.size(); ++i) {
    const VariantKeys& variant = keys.variant_keys[i];
    const Node node = root.member("variants").element(i);
    if (!node.has_members()) continue;
    if (!variant.name.empty() && !names.insert(variant.name).second) {
      node.member("name").fault("two variants are called \"" + variant.name + "\"");
    }
    PatchedPipeline pipeline = changed(pipelines.front().pipeline, variant, node, catalogue);
    const PosesFile poses = poses_of(variant, node, pipeline);
    pipelines.push_back({variant.name, std::move(pipeline), poses});
  }
  return pipelines;
}

/// One value of an axis of a grid.
struct GridPoint {
  std::string label;  ///< Unique among the points of the axis.
  Node value;
};

/// A part of the pipeline and the values that the grid assigns to it.
struct GridAxis {
  std::string path;
  Node node;  ///< The list in the file.
  std::vector<GridPoint> points;
};

/// The type of the stage that `value` describes; empty if it describes none.
std::string type_of(const json& value) {
  for (const char* key : {"type", "step"}) {
    if (value.is_object() && value.contains(key) && value.at(key).is_string()) {
      return value.at(key).get<std::string>();
    }
  }
  return "";
}

/// A value as part of a variant's name; characters not allowed there become `_`.
std::string text_of(const json& value) {
  std::string text = type_of(value);
  if (value.is_string()) text = value.get<std::string>();
  if (value.is_number()) text = params::value_json(value.get<double>());
  if (value.is_array()) {
    for (const json& element : value) text += (text.empty() ? "" : "+") + text_of(element);
  }
  if (text.empty()) text = value.dump();
  for (char& c : text) {
    if (!kVariantName.allows({'x', c, 'x'})) c = '_';
  }
  return text;
}

/// The keys in which stages of the same type differ on an axis, sorted; by type.
std::map<std::string, std::vector<std::string>> differing_keys(const json& values) {
  std::map<std::string, std::map<std::string, std::size_t>> counts;
  std::map<std::string, std::map<std::string, std::set<json>>> differing_values;
  std::map<std::string, std::size_t> stages;
  for (const json& value : values) {
    const std::string type = type_of(value);
    if (type.empty()) continue;
    ++stages[type];
    for (const auto& item : value.items()) {
      ++counts[type][item.key()];
      differing_values[type][item.key()].insert(item.value());
    }
  }
  std::map<std::string, std::vector<std::string>> keys;
  for (const auto& [type, of_type] : differing_values) {
    for (const auto& [key, different] : of_type) {
      const bool is_in_all = counts[type][key] == stages[type];
      if (different.size() > 1 || !is_in_all) keys[type].push_back(key);
    }
  }
  return keys;
}

/// The label of `value` on the axis `key`; labels of stages include the parameters `differing`.
std::string label_of(const std::string& key, const json& value,
                     const std::vector<std::string>& differing) {
  const std::string type = type_of(value);
  if (type.empty()) return key + "=" + text_of(value);
  std::string parameters;
  for (const std::string& parameter : differing) {
    if (!value.contains(parameter)) continue;
    parameters += (parameters.empty() ? "" : " ") + parameter + "=" + text_of(value[parameter]);
  }
  return text_of(type) + (parameters.empty() ? "" : "(" + parameters + ")");
}

std::string last_key(const std::string& path) { return path.substr(path.rfind('.') + 1); }

/// The last key of the path, or the whole path if another axis has the same last key.
std::string axis_key(const json& grid, const std::string& path) {
  int axes = 0;
  for (const auto& [other, values] : grid.items()) axes += last_key(other) == last_key(path);
  return axes == 1 ? last_key(path) : path;
}

/// `label`, or if it is in `labels`, the label with the first free index starting at `index`.
std::string free_label(const std::string& label, std::size_t index,
                       const std::set<std::string>& labels) {
  std::string free = label;
  for (; labels.count(free) > 0; ++index) free = label + " (" + std::to_string(index) + ")";
  return free;
}

/// The axes of the object `grid`, by path. The label of a stage is its type ("pointer_octree"),
/// with the parameters in which it differs from others of that type
/// ("pointer_octree(leaf_size_m=0.1)"); the label of any other value is its key and value
/// ("leaf_size_m=0.1"). Notes faults in the node.
std::vector<GridAxis> read_grid(const Node& grid) {
  std::vector<GridAxis> axes;
  if (!grid.is_object()) return axes;
  for (const auto& [path, values] : grid.value().items()) {
    GridAxis axis{path, grid.member(path), {}};
    if (!axis.node.is_array()) continue;
    if (values.empty()) axis.node.expected("a list of at least one value");
    const std::string key = axis_key(grid.value(), path);
    std::map<std::string, std::vector<std::string>> differing = differing_keys(values);
    std::set<json> known;
    std::set<std::string> labels;
    for (std::size_t i = 0; i < values.size(); ++i) {
      GridPoint point{label_of(key, values[i], differing[type_of(values[i])]),
                      axis.node.element(i)};
      if (!known.insert(values[i]).second) {
        point.value.fault("\"" + point.label + "\" is in this list twice");
      }
      // Lists of stages may differ in something that labels do not show. The index is then added.
      point.label = free_label(point.label, i + 1, labels);
      labels.insert(point.label);
      axis.points.push_back(point);
    }
    axes.push_back(std::move(axis));
  }
  return axes;
}

/// Applies the product of the axes, starting at `axis`, to `point`. Skips axes whose path does not
/// exist in this pipeline; `is_used` records the others.
void multiply_out(const NamedPipeline& point, const std::vector<GridAxis>& axes, std::size_t axis,
                  const Catalogue& catalogue, std::vector<bool>& is_used,
                  std::vector<NamedPipeline>& out) {
  if (out.size() > kMaxVariants) return;
  if (axis == axes.size()) {
    out.push_back(point);
    return;
  }
  bool fits = false;
  std::vector<std::pair<const GridPoint*, std::string>> refused;
  for (const GridPoint& value : axes[axis].points) {
    NamedPipeline next = point;
    const std::string why = replace_value(next.pipeline, axes[axis].path, value.value, catalogue);
    if (!why.empty()) {
      refused.emplace_back(&value, why);
      continue;
    }
    fits = true;
    next.name += "/" + value.label;
    multiply_out(next, axes, axis + 1, catalogue, is_used, out);
  }
  if (!fits) return multiply_out(point, axes, axis + 1, catalogue, is_used, out);
  is_used[axis] = true;
  // The path exists, so each of these values is invalid by itself.
  for (const auto& [value, why] : refused) value->value.fault(why);
}

std::vector<NamedPipeline> apply_grid(const std::vector<NamedPipeline>& pipelines, const Node& grid,
                                      const Catalogue& catalogue) {
  const std::vector<GridAxis> axes = read_grid(grid);
  std::vector<bool> is_used(axes.size(), false);
  std::vector<NamedPipeline> points;
  for (const NamedPipeline& named : pipelines) {
    multiply_out(named, axes, 0, catalogue, is_used, points);
  }
  if (points.size() > kMaxVariants) {
    grid.fault("expected at most " + std::to_string(kMaxVariants) + " variants, found more");
    points.clear();
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (is_used[i] || axes[i].points.empty()) continue;
    PatchedPipeline base = pipelines.front().pipeline;
    axes[i].node.fault(replace_value(base, axes[i].path, axes[i].points.front().value, catalogue));
  }
  return points;
}

/// Adds a fault for each extra that a step of `built` needs and no step provides, and, with
/// `loops`, for each step that only knows the velocity of the reference.
void check_steps(const NamedPipeline& named, const Pipeline& built, bool loops,
                 std::vector<Fault>& faults) {
  for (Fault fault : unmet_needs(named.pipeline, built)) {
    // Names the variant: the fault is at a step that may be part of the base, although it is the
    // variant that removes the step that provides the extra.
    fault.message += ", in variant \"" + named.name + "\"";
    faults.push_back(std::move(fault));
  }
  for (std::size_t i = 0; loops && i < built.size(); ++i) {
    if (dynamic_cast<const GivenMotionStep*>(&*built[i].step) == nullptr) continue;
    faults.push_back(
        fault_of_step(named.pipeline[i],
                      "cannot be used with \"loops\": the velocity is that of the reference, "
                      "not of other targets"));
  }
}

}  // namespace

std::vector<Variant> make_variants(const ExperimentKeys& keys, const Node& root,
                                   const Catalogue& catalogue, std::vector<Fault>& faults) {
  std::vector<NamedPipeline> pipelines = read_pipelines(keys, root, catalogue);
  if (keys.grid) pipelines = apply_grid(pipelines, *keys.grid, catalogue);
  std::vector<Variant> variants;
  for (const NamedPipeline& named : pipelines) {
    const std::string too_long = why_too_long(named.name, kMaxNameBytes, "variants with names");
    if (!too_long.empty()) {
      root.fault(too_long);
      break;
    }
    const std::size_t faults_before = faults.size();
    const Pipeline pipeline = build_pipeline(named.pipeline, catalogue, faults);
    if (faults.size() == faults_before) check_steps(named, pipeline, keys.loops, faults);
    variants.push_back({named.name, pipeline, named.poses});
  }
  return variants;
}

}  // namespace croon::experiments

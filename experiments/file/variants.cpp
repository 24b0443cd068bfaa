#include <nlohmann/json.hpp>

#include "experiments/file/experiment_keys.hpp"
#include "experiments/file/grid.hpp"
#include "experiments/file/patched_pipeline.hpp"

namespace croon::experiments {
namespace {

using params::Node;

constexpr std::size_t kMostVariants = 10000;

struct NamedPipeline {
  std::string name;
  PatchedPipeline pipeline;
};

void note(const Node& node, const std::string& why_not) {
  if (!why_not.empty()) node.fault(why_not);
}

/// The base pipeline `base` as the variant `keys` changes it: steps are inserted, then removed,
/// then replaced. `node` is the variant's.
PatchedPipeline changed(const PatchedPipeline& base, const VariantKeys& keys, const Node& node,
                        const Catalogue& catalogue) {
  PatchedPipeline pipeline = keys.pipeline ? read_steps(*keys.pipeline) : base;
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

/// The base pipeline and that of each variant.
std::vector<NamedPipeline> read_pipelines(const ExperimentKeys& keys, const Node& root,
                                          const Catalogue& catalogue) {
  std::vector<NamedPipeline> pipelines = {{"base", read_steps(*keys.pipeline)}};
  for (std::size_t i = 0; i < keys.variant_keys.size(); ++i) {
    const VariantKeys& variant = keys.variant_keys[i];
    const Node node = root.member("variants").element(i);
    if (!node.has_members()) continue;
    for (const NamedPipeline& other : pipelines) {
      if (!variant.name.empty() && other.name == variant.name) {
        node.member("name").fault("two variants are called \"" + variant.name + "\"");
      }
    }
    pipelines.push_back(
        {variant.name, changed(pipelines.front().pipeline, variant, node, catalogue)});
  }
  return pipelines;
}

/// The product of the axes from `axis` on, applied to `point`. An axis whose path leads nowhere in
/// this pipeline is left out; `is_used` notes which axes were not.
void multiply_out(const NamedPipeline& point, const std::vector<GridAxis>& axes, std::size_t axis,
                  const Catalogue& catalogue, std::vector<bool>& is_used,
                  std::vector<NamedPipeline>& out) {
  if (out.size() > kMostVariants) return;
  if (axis == axes.size()) {
    out.push_back(point);
    return;
  }
  bool fits = false;
  for (const GridPoint& value : axes[axis].points) {
    NamedPipeline next = point;
    if (!replace_value(next.pipeline, axes[axis].path, value.value, catalogue).empty()) continue;
    fits = true;
    next.name += "/" + value.label;
    multiply_out(next, axes, axis + 1, catalogue, is_used, out);
  }
  if (fits) {
    is_used[axis] = true;
  } else {
    multiply_out(point, axes, axis + 1, catalogue, is_used, out);
  }
}

std::vector<NamedPipeline> apply_grid(const std::vector<NamedPipeline>& pipelines, const Node& grid,
                                      const Catalogue& catalogue) {
  const std::vector<GridAxis> axes = read_grid(grid);
  std::vector<bool> is_used(axes.size(), false);
  std::vector<NamedPipeline> points;
  for (const NamedPipeline& named : pipelines) {
    multiply_out(named, axes, 0, catalogue, is_used, points);
  }
  if (points.size() > kMostVariants) {
    grid.fault("expected at most " + std::to_string(kMostVariants) + " variants, found more");
    points.clear();
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (is_used[i] || axes[i].points.empty()) continue;
    PatchedPipeline base = pipelines.front().pipeline;
    axes[i].node.fault(replace_value(base, axes[i].path, axes[i].points.front().value, catalogue));
  }
  return points;
}

}  // namespace

std::vector<Variant> make_variants(const ExperimentKeys& keys, const Node& root,
                                   const Catalogue& catalogue, std::vector<Fault>& faults) {
  std::vector<NamedPipeline> pipelines = read_pipelines(keys, root, catalogue);
  if (keys.grid) pipelines = apply_grid(pipelines, *keys.grid, catalogue);
  std::vector<Variant> variants;
  for (const NamedPipeline& named : pipelines) {
    Variant variant{named.name, {}, ""};
    variant.pipeline = build_pipeline(named.pipeline, catalogue, faults, variant.resolved);
    variants.push_back(std::move(variant));
  }
  return variants;
}

}  // namespace croon::experiments

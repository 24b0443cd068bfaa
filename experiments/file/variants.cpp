#include "experiments/file/variants.hpp"

#include <nlohmann/json.hpp>

#include "experiments/file/grid.hpp"
#include "experiments/file/names.hpp"
#include "experiments/file/patched_pipeline.hpp"
#include "experiments/file/replace_value.hpp"

namespace croon::experiments {
namespace {

using params::Node;

constexpr std::size_t kMostVariants = 10000;

struct NamedPipeline {
  std::string name;
  PatchedPipeline pipeline;
};

void read_name(const Node& variant, const std::vector<NamedPipeline>& others, std::string& name) {
  if (!variant.require("name") || !variant.member("name").read(name)) return;
  if (!is_variant_name(name)) {
    variant.member("name").expected(
        "a name of letters, digits, spaces and _ . - + = ( ), not starting with a dot");
  }
  for (const NamedPipeline& other : others) {
    if (other.name == name)
      variant.member("name").fault("two variants are called \"" + name + "\"");
  }
}

void apply_removals(PatchedPipeline& pipeline, const Node& remove) {
  if (!remove.is_array()) return;
  params::for_each_element(remove, [&](const Node& element) {
    std::string step;
    if (!element.read(step)) return;
    const std::string why_not = remove_step(pipeline, step);
    if (!why_not.empty()) element.fault(why_not);
  });
}

void apply_replacements(PatchedPipeline& pipeline, const Node& replace,
                        const Catalogue& catalogue) {
  if (!replace.is_object()) return;
  for (const auto& item : replace.value().items()) {
    const Node value = replace.member(item.key());
    const std::string why_not = replace_value(pipeline, item.key(), value, catalogue);
    if (!why_not.empty()) value.fault(why_not);
  }
}

NamedPipeline read_variant(const Node& variant, const std::vector<NamedPipeline>& others,
                           const Catalogue& catalogue) {
  NamedPipeline changed = others.front();
  changed.name.clear();
  if (!variant.is_object()) return changed;
  variant.refuse_unknown_keys({"name", "replace", "remove"});
  read_name(variant, others, changed.name);
  if (variant.has("remove")) apply_removals(changed.pipeline, variant.member("remove"));
  if (variant.has("replace")) {
    apply_replacements(changed.pipeline, variant.member("replace"), catalogue);
  }
  return changed;
}

/// The product of the axes from `axis` on, applied to `point`. An axis whose place this pipeline
/// lacks is left out; `is_used` notes which were not.
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

std::vector<Variant> read_variants(const Node& root, const Catalogue& catalogue,
                                   std::vector<Fault>& faults) {
  std::vector<NamedPipeline> pipelines = {{"base", read_steps(root.member("pipeline"))}};
  if (root.has("variants") && root.member("variants").is_array()) {
    params::for_each_element(root.member("variants"), [&](const Node& variant) {
      pipelines.push_back(read_variant(variant, pipelines, catalogue));
    });
  }
  if (root.has("grid")) pipelines = apply_grid(pipelines, root.member("grid"), catalogue);
  std::vector<Variant> variants;
  for (const NamedPipeline& named : pipelines) {
    Variant variant{named.name, {}, ""};
    variant.pipeline =
        build_pipeline(named.pipeline, catalogue, root.file(), faults, variant.resolved);
    variants.push_back(std::move(variant));
  }
  return variants;
}

}  // namespace croon::experiments

#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/basin.hpp"
#include "experiments/analysis/summary.hpp"
#include "framework/pipeline/cloud_description.hpp"

namespace croon::experiments {

// Pictures as SVG. Readable on light and on dark pages; they need no font or script.

/// The bytes of box_plots.svg, like the paper's figure of its real experiment: a panel per DOF, a
/// box per sensor and scene (with several variants: per sensor and variant; for many scenes: per
/// sensor and kind of scene, or per sensor), and the meaning of a box in words. Boxes are quartiles
/// with the median, whiskers reach the last value within 1.5 interquartile ranges (Tukey 1977),
/// values beyond are dots.
std::string box_plots_svg(const Summary& summary);

/// The bytes of basin.svg: success over the size, all sensors together, a line per variant with its
/// 95 % interval.
std::string basin_svg(const Basin& basin);

/// The bytes of ranges.svg: for each sensor the share of points over the range, a line per dataset,
/// mean over scenes.
std::string ranges_svg(const std::vector<CloudDescription>& clouds);

}  // namespace croon::experiments

#pragma once

#include <string>

#include "experiments/report/summary.hpp"

namespace croon::experiments {

/// The bytes of box_plots.svg, the paper's figure of its real experiment: a panel per DOF, a box
/// per sensor and scene (with several variants: per sensor and variant; of many scenes: per sensor
/// and kind of scene, or per sensor), and what a box is in words. Boxes are quartiles with
/// the median, whiskers reach the last value within 1.5 interquartile ranges (Tukey 1977), values
/// beyond are dots. Readable on light and on dark pages; needs no font or script.
std::string box_plots_svg(const Summary& summary);

}  // namespace croon::experiments

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

/// What each box of a sensor is for.
enum class BoxOf { variant, scene, scene_kind, all_scenes };

/// With several variants a box for each, else one for each scene; of more than `max_scenes`, one
/// for each kind of scene; without kinds, or with more than `max_kinds`, one for all scenes.
BoxOf box_of(const Summary& summary, std::size_t max_scenes, std::size_t max_kinds);

/// One box per DOF: its name, its colour, its deviations.
struct BoxSeries {
  std::string label;       ///< Scene, kind or variant; empty if a group has one box alone.
  std::size_t colour = 0;  ///< The same for the same label in every group.
  std::vector<Measures> deviations;
};

/// The boxes of one sensor.
struct BoxGroup {
  std::string sensor;
  std::vector<BoxSeries> boxes;
};

/// The boxes of each sensor; a box without values has no deviations.
std::vector<BoxGroup> box_groups(const Summary& summary, BoxOf of);

/// The bytes of basin.svg: success over the size, all sensors together, a line per variant with its
/// 95 % interval.
std::string basin_svg(const Basin& basin);

/// The bytes of success_curve.svg: the share of trials over the threshold, one panel for rotation
/// and one for translation, the threshold on a logarithmic axis. A line per variant, all sensors
/// together; of one variant alone a line per sensor.
std::string success_curve_svg(const SuccessCurve& curve);

/// The bytes of ranges.svg: for each sensor the share of points over the range, a line per dataset,
/// mean over scenes.
std::string ranges_svg(const std::vector<CloudDescription>& clouds);

}  // namespace croon::experiments

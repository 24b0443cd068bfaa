#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/basin.hpp"
#include "experiments/analysis/coverage.hpp"
#include "experiments/analysis/step_times.hpp"
#include "experiments/analysis/summary.hpp"
#include "experiments/analysis/verdicts.hpp"
#include "framework/picture/drawing.hpp"
#include "framework/pipeline/cloud_description.hpp"

namespace croon::experiments {

/// The position of an entry in a grid that is filled row by row, both counted from zero.
struct GridPosition {
  double row;
  double column;
};

inline GridPosition position_in_grid(std::size_t index, std::size_t columns) {
  const std::size_t row = index / columns;
  return {static_cast<double>(row), static_cast<double>(index - row * columns)};
}

/// The options of a figure.
struct FigureOptions {
  Sheet sheet = {};
  std::string length_unit = {};  ///< "m" or "mm"; empty: mm if all lengths are below 0.1 m.
};

/// The figure of box_plots.svg, like the paper's figure of its real experiment: a panel per DOF, a
/// box per sensor and scene (with several variants: per sensor and variant; for many scenes: per
/// sensor and kind of scene, or per sensor), and an explanation of the boxes. Boxes are quartiles
/// with the median, whiskers extend to the last value within 1.5 interquartile ranges (Tukey 1977),
/// values beyond are dots; see box_drawing.hpp. Below each box are the numbers of its values and
/// trials. The axis may cut bad boxes (see `robust_limit`); arrowheads at its ends show the number
/// of values beyond. Throws InputError if the boxes do not fit the sheet.
Drawing box_plots(const Summary& summary, const FigureOptions& options = {});

/// What each box of a sensor contains.
enum class BoxOf { variant, scene, scene_kind, all_scenes };

/// A box per variant if there are several; otherwise per scene; for more than `max_scenes` scenes,
/// per kind of scene; without kinds, or with more than `max_kinds`, one box of all scenes.
BoxOf box_of(const Summary& summary, std::size_t max_scenes, std::size_t max_kinds);

/// One box per DOF: its name, colour and deviations.
struct BoxSeries {
  std::string label;                 ///< Scene, kind or variant; empty if groups have only one box.
  std::size_t colour = 0;            ///< Equal for equal labels in all groups.
  std::vector<Measures> deviations;  ///< Of the counted trials.
  int trials = 0;                    ///< Number of all trials.
};

/// The boxes of one sensor.
struct BoxGroup {
  std::string sensor;
  std::vector<BoxSeries> boxes;
};

/// The boxes of each sensor; a box without values has no deviations.
std::vector<BoxGroup> box_groups(const Summary& summary, BoxOf of);

/// Shortens the label of each series for a figure, see `distinct_labels`.
void shorten_labels(std::vector<BoxGroup>& groups, std::size_t columns);

/// The figure of success_curve.svg: the share of all trials within a threshold of ground truth, one
/// panel for rotation and one for translation, with a logarithmic threshold axis. A line per
/// variant, over all sensors; for a single variant a line per sensor. The band around a line is the
/// interval over scenes, if there are enough.
Drawing success_curve_chart(const SuccessCurve& curve, const FigureOptions& options = {});

/// The figure of coverage.svg, a calibration plot: how often intervals contain ground truth, over
/// their level, a panel per degree of freedom. A line per variant, over all sensors; for a single
/// variant a line per sensor.
Drawing coverage_chart(const Coverage& coverage, const FigureOptions& options = {});

/// The figure of verdicts.svg: right and wrong poses, accepted and rejected, in % of all trials,
/// over the threshold above which a pose is wrong, in multiples of `bounds`. A panel for each of
/// the four, with its own axis. A line per variant, over all sensors; for a single variant a line
/// per sensor.
Drawing acceptance_chart(const AcceptanceCurve& acceptance, const SuccessBounds& bounds,
                         const FigureOptions& options = {});

/// The figure of kinds.svg: success by kind of scene (without ground truth: agreement), over all
/// sensors, a bar per variant with its 95 % interval.
Drawing kinds_chart(const Summary& summary, const FigureOptions& options = {});

/// The figure of median wall times: a stacked bar per variant, with a segment per step.
Drawing times_chart(const std::vector<StepTime>& times, const FigureOptions& options = {});

/// The maximum value that the axis of a measure has to show: three times the lower median of the
/// boxes' longer whiskers, so that the boxes of bad variants do not flatten those of good ones; but
/// at least the longer whisker of the best box of every sensor, up to ten times that median, and at
/// least ten times the last digit shown in tables.
double robust_limit(const std::vector<BoxGroup>& groups, std::size_t measure);

/// The figure of basin.svg: success over the size of the perturbation, over all sensors, a line per
/// variant with its 95 % interval.
Drawing basin_chart(const Basin& basin, const FigureOptions& options = {});

/// The figure of ranges.svg: for each sensor the share of points over the range, a line per
/// dataset, averaged over scenes.
Drawing ranges_chart(const std::vector<CloudDescription>& clouds,
                     const FigureOptions& options = {});

}  // namespace croon::experiments

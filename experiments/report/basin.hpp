#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/file/start_rule.hpp"
#include "experiments/report/summary.hpp"
#include "experiments/report/table.hpp"

namespace croon::experiments {

/// The share of successful trials from which a level belongs to the basin.
inline constexpr double kBasinRatio = 0.95;

/// The success of one variant over the levels of a sweep.
struct BasinRow {
  std::string variant;
  std::string sensor;         ///< Empty for all sensors together.
  std::vector<Share> levels;  ///< From the smallest size.
};

/// How far from the truth each variant finds home.
struct Basin {
  Sweep sweep;
  std::vector<BasinRow> rows;  ///< By variant, then sensor, all together last.
};

/// What the records of a sweep come to; all trials count, those that failed too. Sensors without
/// truth are left out: nobody knows where they ended; nothing where that are all. The order of the
/// records makes no difference.
std::optional<Basin> basin_of(const std::vector<TrialRecord>& records, const Sweep& sweep,
                              const ReportOrder& order);

/// The basin's radius, deg or m: the largest size up to which at every level, `kBasinRatio` of the
/// trials succeed; nothing where the first level is worse.
std::optional<double> basin_radius(const Sweep& sweep, const BasinRow& row);

/// "deg" or "m".
const char* size_unit(const Sweep& sweep);

/// The bytes of basin.csv: a row per variant, sensor ("all" for all together) and level.
std::string basin_csv(const Basin& basin);

/// Success in % per variant (rows) and level (columns), all sensors together, and the radius; of
/// many levels every second, third, ... is shown. Ends with a newline.
std::string basin_table(const Basin& basin, const TableStyle& style = {});

/// Success over the size as a picture (SVG), all sensors together: a line per variant with its 95 %
/// interval.
std::string basin_svg(const Basin& basin);

}  // namespace croon::experiments

#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "framework/geometry/dof.hpp"

namespace croon::experiments {

/// A number that compares one pose with another, in the unit of reports.
struct Measure {
  const char* name;  ///< "roll", as in the column `roll_error_deg`.
  const char* unit;  ///< "deg" or "m".
  int decimals;      ///< In tables: methods differ by millidegrees and tenths of millimetres.
};

/// The six DOFs in the order of `Vector6d`, then the two distances. The only list of measures;
/// claims, CSV and JSON files and tables are derived from it.
inline constexpr std::array kMeasures = {
    Measure{"roll", "deg", 3},     Measure{"pitch", "deg", 3},    Measure{"yaw", "deg", 3},
    Measure{"x", "m", 4},          Measure{"y", "m", 4},          Measure{"z", "m", 4},
    Measure{"rotation", "deg", 3}, Measure{"translation", "m", 4}};

/// The DOFs are the first measures.
inline constexpr std::size_t kDofs = 6;

/// The indices of the two distances.
inline constexpr std::size_t kRotation = 6;
inline constexpr std::size_t kTranslation = 7;

/// The DOFs in the order of the paper's tables: pitch, roll, yaw, x, y, z.
inline constexpr std::array<std::size_t, kDofs> kPaperOrder = {1, 0, 2, 3, 4, 5};

/// One number per measure, in their order and units.
using Measures = std::array<double, kMeasures.size()>;

/// `error` in the units of `kMeasures`.
Measures measures_of(const PoseError& error);

/// The name with its unit, "roll_deg".
std::string name_with_unit(const Measure& measure);

/// The names of all measures, in their order.
std::vector<std::string> measure_names();

/// The index of the measure `name`. Throws std::logic_error for an unknown name.
std::size_t measure_index(std::string_view name);

}  // namespace croon::experiments

#include "framework/io/float_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/io/cloud_columns.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

constexpr std::size_t kFloatBytes = sizeof(float);
constexpr std::size_t kMinRowFloats = 3, kMaxRowFloats = 8;
constexpr const char* kRemedy =
    "; specify their number (columns), rename nuScenes files to .pcd.bin, or convert the file to "
    "PCD, PLY or NumPy";

/// Features that distinguish the numbers of different columns: magnitude, signed magnitude, and
/// whether they are whole.
constexpr std::size_t kFeatures = 3;
using Features = std::array<double, kFeatures>;

Features features_of(double value) {
  if (!std::isfinite(value)) value = 0.0;
  constexpr double kMaxSize = 1e4, kMinSize = 0.01, kMaxValue = 100.0;
  return {std::log(std::min(std::abs(value), kMaxSize) + kMinSize),
          std::clamp(value, -kMaxValue, kMaxValue), value == std::trunc(value) ? 1.0 : 0.0};
}

/// The first numbers of a file, which are all that the check of the header can see.
class Sample {
 public:
  explicit Sample(std::string_view head) {
    head = head.substr(0, kMaxHeaderBytes);
    for (std::size_t at = 0; at + kFloatBytes <= head.size(); at += kFloatBytes) {
      values_.push_back(
          decode_scalar(scalar_type_of<float>(), ByteOrder::little, head.data() + at));
      features_.push_back(features_of(values_.back()));
    }
  }

  /// How strongly numbers depend on their column: n times the correlation ratio, summed over the
  /// features, minus its expectation by chance.
  double evidence(std::size_t columns) const {
    const std::vector<Features> means = column_means(columns);
    const Features mean = column_means(1).front();
    const auto n = static_cast<double>(features_.size());
    double sum = 0.0;
    for (std::size_t f = 0; f < kFeatures; ++f) {
      double total = 0.0, between = 0.0;
      for (std::size_t i = 0; i < features_.size(); ++i) {
        total += square(features_[i][f] - mean[f]);
        between += square(means[i % columns][f] - mean[f]);
      }
      if (total > 1e-9 * n) sum += n * between / total;
    }
    return sum - static_cast<double>(kFeatures * (columns - 1));
  }

  /// Whether the second half of rows of `columns` contains other quantities than the first half,
  /// rather than the next point.
  bool has_other_second_half(std::size_t columns) const {
    constexpr double kMinLogRatio = 1.0, kMinWhole = 0.5;
    const std::vector<Features> means = column_means(columns);
    for (std::size_t i = 0; i < columns / 2; ++i) {
      const Features &one = means[i], &two = means[i + columns / 2];
      if (std::abs(one[0] - two[0]) > kMinLogRatio || std::abs(one[2] - two[2]) > kMinWhole) {
        return true;
      }
    }
    return false;
  }

  bool is_ring(std::size_t column, std::size_t columns) const {
    constexpr double kMaxRing = 255.0;
    for (std::size_t i = column; i < values_.size(); i += columns) {
      const double value = values_[i];
      if (!(value >= 0.0 && value <= kMaxRing && value == std::trunc(value))) return false;
    }
    return values_.size() > column;
  }

  /// The share of rows with a coordinate beyond the range of any LiDAR.
  double share_out_of_range(std::size_t columns) const {
    constexpr double kMaxPlausible_m = 1000.0;
    std::size_t rows = 0, outside = 0;
    for (std::size_t row = 0; row + columns <= values_.size(); row += columns, ++rows) {
      const auto is_outside = [](double value) { return std::abs(value) > kMaxPlausible_m; };
      if (std::any_of(&values_[row], &values_[row] + 3, is_outside)) ++outside;
    }
    return rows == 0 ? 0.0 : static_cast<double>(outside) / static_cast<double>(rows);
  }

 private:
  static double square(double x) { return x * x; }

  std::vector<Features> column_means(std::size_t columns) const {
    std::vector<Features> means(columns, Features{});
    std::vector<std::size_t> counts(columns, 0);
    for (std::size_t i = 0; i < features_.size(); ++i) {
      ++counts[i % columns];
      for (std::size_t f = 0; f < kFeatures; ++f) means[i % columns][f] += features_[i][f];
    }
    for (std::size_t c = 0; c < columns; ++c) {
      for (double& mean : means[c])
        mean /= static_cast<double>(std::max<std::size_t>(counts[c], 1));
    }
    return means;
  }

  std::vector<double> values_;
  std::vector<Features> features_;
};

/// The evidence for each number of columns that divides the file's length.
std::map<std::size_t, double> evidence_of(const Sample& sample, std::uint64_t floats,
                                          const std::string& file) {
  std::map<std::size_t, double> evidence;
  for (std::size_t columns = kMinRowFloats; columns <= kMaxRowFloats; ++columns) {
    if (floats % columns == 0) evidence[columns] = sample.evidence(columns);
  }
  for (const std::size_t columns : {6U, 8U}) {
    // With few rows, the halves differ by chance.
    constexpr std::size_t kMinRows = 20;
    if (evidence.count(columns) == 0 || floats < kMinRows * columns) continue;
    evidence.erase(sample.has_other_second_half(columns) ? columns / 2 : columns);
  }
  // Priors for the numbers of columns in published data sets: with few points, the content is
  // inconclusive.
  constexpr double kUsual = 20.0, kOfSuffix = 1000.0;
  for (const std::size_t columns : {4U, 5U}) {
    if (evidence.count(columns) > 0) evidence[columns] += kUsual;
  }
  constexpr std::string_view kNuScenes = ".pcd.bin";
  const bool is_nuscenes =
      file.size() >= kNuScenes.size() &&
      file.compare(file.size() - kNuScenes.size(), kNuScenes.size(), kNuScenes) == 0;
  if (is_nuscenes && evidence.count(5) > 0) evidence[5] += kOfSuffix;
  return evidence;
}

/// The number of columns with the most evidence. Throws InputError if another number is about as
/// likely.
std::size_t best_of(const std::map<std::size_t, double>& evidence, const std::string& file) {
  constexpr double kMinLead = 10.0;
  const auto is_less = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto best = std::max_element(evidence.begin(), evidence.end(), is_less);
  for (const auto& [columns, score] : evidence) {
    if (columns == best->first || score < best->second - kMinLead) continue;
    throw InputError(file, "",
                     "cannot distinguish rows of " +
                         std::to_string(std::min(columns, best->first)) + " floats from rows of " +
                         std::to_string(std::max(columns, best->first)) + kRemedy);
  }
  return best->first;
}

void check_number(std::size_t columns) {
  if (columns == 0 || (columns >= kMinRowFloats && columns <= kMaxRowFloats)) return;
  throw InputError("", "columns",
                   "expected rows of " + std::to_string(kMinRowFloats) + " to " +
                       std::to_string(kMaxRowFloats) + " floats, found " + std::to_string(columns));
}

}  // namespace

std::string name_of_column(std::size_t column, std::size_t columns) {
  const bool is_intensity = column == 3 && columns <= 5;
  return is_intensity ? kIntensity : "column_" + std::to_string(column + 1);
}

FloatRows float_rows(std::string_view head, std::uint64_t file_bytes, const std::string& file,
                     std::size_t columns) {
  check_number(columns);
  const std::uint64_t floats = file_bytes / kFloatBytes;
  const Sample sample(head);
  const std::map<std::size_t, double> evidence = evidence_of(sample, floats, file);
  const bool is_whole =
      file_bytes % kFloatBytes == 0 && (columns == 0 ? !evidence.empty() : floats % columns == 0);
  if (!is_whole) {
    const std::string rows = columns == 0 ? "4 or 5" : std::to_string(columns);
    throw InputError(file, "",
                     "expected rows of " + rows + " floats (x, y, z, intensity, ...), found " +
                         std::to_string(file_bytes) + " bytes");
  }
  FloatRows rows;
  rows.columns = columns != 0 || file_bytes == 0 ? columns : best_of(evidence, file);
  if (rows.columns == 0) rows.columns = 4;
  constexpr double kMaxShare = 0.01;
  if (columns == 0 && sample.share_out_of_range(rows.columns) > kMaxShare) {
    throw InputError(file, "",
                     "expected rows of " + std::to_string(rows.columns) +
                         " floats, found coordinates beyond 1 km" + kRemedy);
  }
  const bool has_ring = rows.columns > 4 && sample.is_ring(4, rows.columns);
  for (std::size_t c = 3; c < rows.columns; ++c) {
    rows.channels.push_back(c == 4 && has_ring ? kRing
                                               : name_of_column(c, has_ring ? 5 : rows.columns));
  }
  return rows;
}

LoadedCloud parse_float_rows(std::string_view bytes, const std::string& file, std::size_t columns,
                             const Eigen::Vector3d& origin_m) {
  const FloatRows rows = float_rows(bytes, bytes.size(), file, columns);
  const auto column = [&](std::size_t c) {
    return CloudColumn{c < 3 ? "" : rows.channels[c - 3], scalar_type_of<float>(), 1,
                       bytes.data() + c * kFloatBytes, rows.columns * kFloatBytes};
  };
  std::vector<CloudColumn> channels;
  for (std::size_t c = 3; c < rows.columns; ++c) channels.push_back(column(c));
  LoadedCloud cloud;
  cloud.origin_m = origin_m;
  if (rows.columns != 4) {
    cloud.notes.push_back("The file is read as rows of " + std::to_string(rows.columns) +
                          " floats.");
  }
  return from_columns(std::move(cloud), bytes.size() / (rows.columns * kFloatBytes),
                      {column(0), column(1), column(2)}, channels);
}

}  // namespace croon

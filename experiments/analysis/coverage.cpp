#include "experiments/analysis/coverage.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "experiments/analysis/paired_tests.hpp"

namespace croon::experiments {
namespace {

/// The index of the ellipsoid of all six among the rows of a sensor.
constexpr std::size_t kAllSix = 6;

/// The level of the ellipsoid that contains a normalised squared error of six degrees of freedom on
/// its surface: the chi-squared distribution, in closed form for an even number of degrees.
double level_of(double squared) {
  const double half = 0.5 * squared;
  return std::isfinite(half) ? 1.0 - std::exp(-half) * (1.0 + half + 0.5 * half * half) : 1.0;
}

/// The accepted trials of one variant and sensor.
class Held {
 public:
  void add(const TrialRecord& record) {
    const Vector6d& error = record.error->dof;
    const Matrix6d& covariance = record.covariance->matrix;
    const double squared = normalised_squared_error(error, covariance);
    for (std::size_t k = 0; k < kCoverageLevels.size(); ++k) {
      static const std::vector<double> half_widths = [] {
        std::vector<double> widths;
        for (const double level : kCoverageLevels) widths.push_back(half_width_of(level));
        return widths;
      }();
      for (std::size_t i = 0; i < kAllSix; ++i) {
        const auto dof = static_cast<Eigen::Index>(i);
        const double bound = half_widths[k] * std::sqrt(covariance(dof, dof));
        counts_[i][k].add(record.id.scene, std::abs(error(dof)) <= bound ? 1 : 0, 1);
      }
      counts_[kAllSix][k].add(record.id.scene, level_of(squared) <= kCoverageLevels[k] ? 1 : 0, 1);
    }
    // An error where the covariance is zero is outside every interval, and has no finite mean.
    if (!std::isfinite(squared)) return;
    squared_.push_back(squared);
    const std::size_t next = scenes_.size();
    clusters_.push_back(scenes_.emplace(record.id.scene, next).first->second);
  }

  void give(const std::string& variant, const std::string& sensor, Coverage& coverage) const {
    for (std::size_t i = 0; i <= kAllSix; ++i) {
      CoverageRow row{variant, sensor, std::nullopt, {}};
      if (i < kAllSix) row.dof = static_cast<Dof>(i);
      for (const SceneCounts& counts : counts_[i]) row.held.push_back(counts.share());
      coverage.rows.push_back(std::move(row));
    }
    if (squared_.empty()) return;
    NormalisedErrors errors{variant, sensor, static_cast<int>(squared_.size()), 0.0, 0.0, {}};
    errors.mean = mean(squared_);
    errors.median = median_with_failures(squared_);
    if (scenes_.size() >= static_cast<std::size_t>(kMinScenes)) {
      const Pairs against_zero = {std::vector<double>(squared_.size(), 0.0), squared_};
      errors.interval = median_difference_interval(against_zero, clusters_);
    }
    coverage.errors.push_back(errors);
  }

 private:
  std::array<std::array<SceneCounts, kCoverageLevels.size()>, kAllSix + 1> counts_;
  std::vector<double> squared_;
  Clusters clusters_;
  std::map<std::string, std::size_t> scenes_;
};

/// Whether the program accepts the pose, and its ground truth and covariance are known.
bool is_covered(const TrialRecord& record) {
  return record.status != Status::rejected && record.error && record.covariance;
}

}  // namespace

std::string name_of_dof(const CoverageRow& row) {
  return row.dof ? kDofNames.at(static_cast<std::size_t>(*row.dof)) : "all";
}

double half_width_of(double level) {
  return boost::math::quantile(boost::math::normal(), 0.5 + 0.5 * level);
}

double normalised_squared_error(const Vector6d& error, const Matrix6d& covariance) {
  // In standard deviations, because rotations and translations have different units.
  Vector6d scale = Vector6d::Zero();
  for (int i = 0; i < 6; ++i) {
    if (covariance(i, i) > 0.0) scale(i) = 1.0 / std::sqrt(covariance(i, i));
    if (covariance(i, i) <= 0.0 && error(i) != 0.0) return std::numeric_limits<double>::infinity();
  }
  const Matrix6d correlations = scale.asDiagonal() * covariance * scale.asDiagonal();
  const Vector6d scaled = scale.cwiseProduct(error);
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(correlations);
  double sum = 0.0;
  for (int i = 0; i < 6; ++i) {
    const double along = solver.eigenvectors().col(i).dot(scaled);
    // Keeps rounding errors from counting as information.
    sum += along * along / std::max(solver.eigenvalues()(i), 1e-9);
  }
  return sum;
}

Coverage coverage_of(const std::vector<TrialRecord>& records, const Summary& summary) {
  std::map<VariantSensor, Held> held;
  for (const TrialRecord& record : records) {
    if (!is_covered(record)) continue;
    held[{record.id.variant, record.id.sensor}].add(record);
    held[{record.id.variant, ""}].add(record);
  }
  std::vector<std::string> sensors = sensors_of(summary);
  sensors.emplace_back();
  Coverage coverage;
  for (const std::string& variant : variants_of(summary)) {
    for (const std::string& sensor : sensors) {
      const auto found = held.find({variant, sensor});
      if (found != held.end()) found->second.give(variant, sensor, coverage);
    }
  }
  return coverage;
}

}  // namespace croon::experiments

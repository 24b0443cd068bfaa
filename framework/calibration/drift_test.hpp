#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "framework/calibration/check_rig.hpp"
#include "framework/geometry/dof.hpp"

namespace croon {

/// When a sensor counts as drifted.
struct DriftTestOptions {
  /// The threshold of the statistic, see drift_threshold.
  double threshold = 5.8;
  /// A constant offset up to this is no drift: the scatter of real scenes.
  double tolerance_rad = kScatter_rad;
  double tolerance_m = kScatter_m;
};

/// The threshold h that the maximum of `tests` statistics of DriftTest, one per sensor and degree
/// of freedom, exceeds once in `mean_scans` scans on average if nothing drifts and all offsets are
/// at the tolerance. The mean time of one statistic is `sqrt(2 pi) exp(h^2/2) / (c h)` (Siegmund
/// and Venkatraman, Annals of Statistics 1995, theorem 1), with c for the windows used here.
double drift_threshold(double mean_scans, int tests);

/// The verdict on a sensor after a scan.
enum class DriftState {
  undecidable,  ///< Too few usable scans, or too uncertain ones.
  right,        ///< The given pose is right within the tolerance, as far as the test can tell.
  drifted       ///< The sensor is not at its given pose.
};

/// "undecidable", "right", "drifted".
const char* name_of(DriftState state);

/// A sequential test whether the mean of a six-dimensional series of differences leaves a
/// tolerance, by degree of freedom: a generalised likelihood ratio over windows (Basseville and
/// Nikiforov, Detection of Abrupt Changes, 1993, section 2.4.3; Lorden 1971) with these properties:
/// - The statistic of a window of n scans is `max(0, |m| - tolerance) / std(m)` for the weighted
///   mean m; the largest of n = 4, 8, ..., 128 is compared with the threshold.
/// - Values are clipped three standard deviations beyond the tolerance (Huber 1981), so that
///   fewer than four bad scans cannot raise an alarm.
/// - Consecutive scans see the same surfaces, so their errors are correlated, and the covariances
///   may be wrong: the variance of a mean is that of independent errors times an inflation, which
///   is measured by the differences between the means of consecutive blocks of 16 scans, and at
///   least 1; a fifth of the standard deviation of a scan does not average out at all.
/// The memory is constant.
class DriftTest {
 public:
  explicit DriftTest(const DriftTestOptions& options = {});

  /// Adds a usable scan: the difference of the pose and its standard deviations, rad and m. `scan`
  /// is a number that increases.
  void add(std::size_t scan, const Vector6d& difference, const Vector6d& deviations);
  /// Adds a scan without an estimate.
  void add_missing();

  DriftState state() const { return state_; }
  /// By degree of freedom, after the last usable scan.
  const Vector6d& statistics() const { return statistics_; }
  double threshold() const { return options_.threshold; }
  /// By degree of freedom: the factor on the variance of a mean.
  const Vector6d& inflations() const { return inflations_; }

  /// The offset of one degree of freedom.
  struct Change {
    Dof dof = Dof::roll;
    double size = 0.0;       ///< The median, rad or m.
    double deviation = 0.0;  ///< Of the mean.
    std::size_t since = 0;   ///< The most likely first scan of it.
    /// Whether `since` is the first scan in memory: the pose may have been wrong before.
    bool is_from_start = false;
  };
  /// The offset of the degree of freedom `dof` over the most likely window.
  Change change(Dof dof) const;
  /// That with the largest statistic.
  Change largest_change() const;

 private:
  struct Scan {
    std::size_t number = 0;
    Vector6d difference, clipped, weights;
  };

  double tolerance(int dof) const;
  /// The standard deviation of the mean of so many scans with weights of this sum.
  double mean_deviation(double weight, std::size_t scans, int dof) const;
  void add_to_block(const Vector6d& clipped, const Vector6d& weights);
  void update_statistics();
  void update_state();
  /// Whether a window of recent scans is certain enough for a verdict.
  bool is_certain() const;

  DriftTestOptions options_;
  DriftState state_ = DriftState::undecidable;
  std::deque<Scan> scans_;   ///< The last usable ones.
  std::deque<bool> usable_;  ///< Of the last scans.
  std::size_t first_scan_ = 0;
  bool has_scans_ = false;
  Vector6d statistics_ = Vector6d::Zero();
  Vector6d recent_statistics_ = Vector6d::Zero();  ///< Of the last 16 scans.
  std::size_t since_state_ = 0;                    ///< Usable scans since the state changed.

  // The measured inflation.
  Vector6d inflations_, inflation_sums_, inflation_weights_;
  Vector6d block_sums_ = Vector6d::Zero(), block_weights_ = Vector6d::Zero();
  std::size_t in_block_ = 0;
  struct BlockMean {
    Vector6d mean, variance;
  };
  std::optional<BlockMean> last_block_;
};

}  // namespace croon

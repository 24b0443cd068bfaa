#include "framework/calibration/drift_test.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "framework/base/angles.hpp"
#include "framework/base/statistics.hpp"

namespace croon {
namespace {

constexpr std::size_t kMinWindow = 4, kMaxWindow = 128;
constexpr std::size_t kBlockScans = 16;

/// The part of the standard deviation of a scan that is common to a window: errors of one place do
/// not average out while the sensors see it. Tuned on simulated drives.
constexpr double kCommonShare = 0.2;

/// Clipping, in standard deviations beyond the tolerance.
constexpr double kClip = 3.0;

// The inflation before any block is seen, the number of blocks that it counts as, and the number
// after which old blocks are forgotten.
constexpr double kFirstInflation = 1.5;
constexpr double kFirstBlocks = 10.0;
constexpr double kMaxBlocks = 200.0;

// A sensor becomes undecidable if fewer of the last kRecent scans are usable than kMinUsable, and
// decidable if at least kEnough are.
constexpr std::size_t kRecent = 16, kMinUsable = 4, kEnough = 12;

/// Offsets that would not be noticed make a sensor undecidable from here.
constexpr double kMaxUnnoticed_rad = rad_from_deg(0.5);
constexpr double kMaxUnnoticed_m = 0.1;

/// A drifted sensor is right again if the statistics of its last scans are below this share of the
/// threshold.
constexpr double kBackShare = 0.35;

}  // namespace

const char* name_of(DriftState state) {
  switch (state) {
    case DriftState::right:
      return "right";
    case DriftState::drifted:
      return "drifted";
    case DriftState::undecidable:
      break;
  }
  return "undecidable";
}

double drift_threshold(double mean_scans, int tests) {
  // For windows of all lengths, theory has 0.7355; measured for those of DriftTest on white noise.
  constexpr double kWindows = 0.25;
  const double mean_of_one = std::max(10.0, mean_scans * tests);
  double h = 3.0;
  // A contraction for h > 1.
  constexpr int kIterations = 60;
  for (int i = 0; i < kIterations; ++i) {
    h = std::sqrt(std::max(1.0, 2.0 * std::log(mean_of_one * kWindows * h / std::sqrt(2.0 * kPi))));
  }
  return h;
}

DriftTest::DriftTest(const DriftTestOptions& options) : options_(options) {
  inflations_.setConstant(kFirstInflation);
  inflation_sums_.setConstant(kFirstInflation * kFirstBlocks);
  inflation_weights_.setConstant(kFirstBlocks);
}

double DriftTest::tolerance(int dof) const {
  return is_rotation(static_cast<Dof>(dof)) ? options_.tolerance_rad : options_.tolerance_m;
}

double DriftTest::mean_deviation(double weight, std::size_t scans, int dof) const {
  const double common = kCommonShare * kCommonShare * static_cast<double>(scans);
  return std::sqrt((inflations_(dof) + common) / weight);
}

void DriftTest::add(std::size_t scan, const Vector6d& difference, const Vector6d& deviations) {
  if (!has_scans_) first_scan_ = scan;
  has_scans_ = true;
  Scan added{scan, difference, difference, deviations.cwiseAbs2().cwiseInverse()};
  for (int i = 0; i < 6; ++i) {
    const double limit = tolerance(i) + kClip * std::sqrt(inflations_(i)) * deviations(i);
    added.clipped(i) = std::clamp(difference(i), -limit, limit);
  }
  scans_.push_back(added);
  if (scans_.size() > kMaxWindow) scans_.pop_front();
  usable_.push_back(true);
  if (usable_.size() > kRecent) usable_.pop_front();
  add_to_block(added.clipped, added.weights);
  update_statistics();
  ++since_state_;
  update_state();
}

void DriftTest::add_missing() {
  usable_.push_back(false);
  if (usable_.size() > kRecent) usable_.pop_front();
  update_state();
}

void DriftTest::add_to_block(const Vector6d& clipped, const Vector6d& weights) {
  block_sums_ += weights.cwiseProduct(clipped);
  block_weights_ += weights;
  if (++in_block_ < kBlockScans) return;
  const BlockMean block{block_sums_.cwiseQuotient(block_weights_), block_weights_.cwiseInverse()};
  if (last_block_) {
    for (int i = 0; i < 6; ++i) {
      const double apart = block.mean(i) - last_block_->mean(i);
      const double square = apart * apart / (block.variance(i) + last_block_->variance(i));
      // A knock between two blocks must not count as noise.
      inflation_sums_(i) += std::min(square, kClip * kClip * inflations_(i));
      inflation_weights_(i) += 1.0;
      if (inflation_weights_(i) > kMaxBlocks) {
        inflation_sums_(i) *= kMaxBlocks / inflation_weights_(i);
        inflation_weights_(i) = kMaxBlocks;
      }
      inflations_(i) = std::max(1.0, inflation_sums_(i) / inflation_weights_(i));
    }
  }
  last_block_ = block;
  block_sums_.setZero();
  block_weights_.setZero();
  in_block_ = 0;
}

void DriftTest::update_statistics() {
  Vector6d sums = Vector6d::Zero(), weights = Vector6d::Zero();
  statistics_.setZero();
  recent_statistics_.setZero();
  std::size_t window = kMinWindow;
  for (std::size_t n = 1; n <= scans_.size(); ++n) {
    const Scan& scan = scans_[scans_.size() - n];
    sums += scan.weights.cwiseProduct(scan.clipped);
    weights += scan.weights;
    if (n != window) continue;
    window *= 2;
    for (int i = 0; i < 6; ++i) {
      const double beyond = std::max(0.0, std::abs(sums(i) / weights(i)) - tolerance(i));
      const double statistic = beyond / mean_deviation(weights(i), n, i);
      statistics_(i) = std::max(statistics_(i), statistic);
      if (n == kRecent) recent_statistics_(i) = statistic;
    }
  }
}

bool DriftTest::is_certain() const {
  Vector6d weights = Vector6d::Zero();
  const std::size_t scans = std::min(scans_.size(), kRecent);
  for (std::size_t n = 1; n <= scans; ++n) {
    weights += scans_[scans_.size() - n].weights;
  }
  for (int i = 0; i < 6; ++i) {
    const double unnoticed =
        tolerance(i) + options_.threshold * mean_deviation(weights(i), scans, i);
    if (!(unnoticed <= (is_rotation(static_cast<Dof>(i)) ? kMaxUnnoticed_rad : kMaxUnnoticed_m))) {
      return false;
    }
  }
  return true;
}

void DriftTest::update_state() {
  const auto usable = static_cast<std::size_t>(std::count(usable_.begin(), usable_.end(), true));
  const bool is_enough =
      usable >= (state_ == DriftState::undecidable ? kEnough : kMinUsable) && is_certain();
  DriftState next = state_;
  if (!is_enough && usable_.size() == kRecent) {
    next = DriftState::undecidable;
  } else if (statistics_.maxCoeff() > options_.threshold) {
    next = DriftState::drifted;
  } else if (state_ == DriftState::drifted) {
    const bool is_back =
        since_state_ >= kRecent && recent_statistics_.maxCoeff() < kBackShare * options_.threshold;
    if (is_back) next = DriftState::right;
  } else if (is_enough) {
    next = DriftState::right;
  }
  if (next != state_) since_state_ = 0;
  state_ = next;
}

DriftTest::Change DriftTest::change(Dof dof) const {
  const auto i = static_cast<int>(dof);
  Change change;
  change.dof = dof;
  double sum = 0.0, weight = 0.0, best = 0.0;
  std::vector<double> values;
  for (std::size_t n = 1; n <= scans_.size(); ++n) {
    const Scan& scan = scans_[scans_.size() - n];
    sum += scan.weights(i) * scan.clipped(i);
    weight += scan.weights(i);
    values.push_back(scan.difference(i));
    const double deviation = mean_deviation(weight, n, i);
    const double statistic = (std::abs(sum / weight) - tolerance(i)) / deviation;
    if (n < std::min(kMinWindow, scans_.size())) continue;
    if (change.deviation > 0.0 && statistic <= best) continue;
    best = statistic;
    change.size = median(values);
    change.deviation = deviation;
    change.since = scan.number;
    change.is_from_start = scan.number <= first_scan_ + kMinWindow;
  }
  return change;
}

DriftTest::Change DriftTest::largest_change() const {
  int largest = 0;
  statistics_.maxCoeff(&largest);
  return change(static_cast<Dof>(largest));
}

}  // namespace croon

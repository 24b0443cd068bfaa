#include "framework/calibration/check_rig.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"

namespace croon {
namespace {

/// Minimum number of standard deviations from which a degree of freedom is reported.
constexpr double kNamedDeviations = 3.0;

/// Maximum standard deviations at which a degree of freedom can be judged.
constexpr double kMaxDeviation_rad = rad_from_deg(0.5);
constexpr double kMaxDeviation_m = 0.1;

/// The covariance of the difference between an optimum and the pose that a perfect calibration of
/// the same sensors finds: without the error budget, because both poses have the systematic errors.
Matrix6d covariance_of_difference(const CalibratedSensor& calibrated) {
  Matrix6d sum = Matrix6d::Zero();
  if (calibrated.covariance) {
    sum = calibrated.covariance->matrix - calibrated.error_budget.value_or(sum);
    sum = bounded_covariance(sum);
  }
  for (int i = 0; i < 6; ++i) {
    const double scatter = is_rotation(static_cast<Dof>(i)) ? kScatter_rad : kScatter_m;
    sum(i, i) += scatter * scatter;
  }
  return sum;
}

void set_optimum(CheckedSensor& checked, const CalibratedSensor& calibrated) {
  checked.optimum = calibrated.T_reference_sensor;
  const Matrix6d covariance = covariance_of_difference(calibrated);
  checked.difference = pose_error(*checked.given, *checked.optimum).dof;
  checked.deviations = covariance.diagonal().cwiseSqrt();
  checked.distance =
      std::sqrt(std::max(0.0, checked.difference.dot(covariance.ldlt().solve(checked.difference))));
}

/// "+0.42°", "-52.0 mm".
std::string length_text(int dof, double value) {
  const std::string sign = value < 0.0 ? "-" : "+";
  return is_rotation(static_cast<Dof>(dof))
             ? sign + fixed_number(std::abs(deg_from_rad(value)), 2) + "°"
             : sign + fixed_number(std::abs(1e3 * value), 1) + " mm";
}

double in_deviations(const CheckedSensor& checked, int dof) {
  return std::abs(checked.difference(dof)) / checked.deviations(dof);
}

/// The degrees of freedom, by decreasing number of standard deviations.
std::vector<int> by_deviations(const CheckedSensor& checked) {
  std::vector<int> dofs(6);
  std::iota(dofs.begin(), dofs.end(), 0);
  std::stable_sort(dofs.begin(), dofs.end(), [&](int a, int b) {
    return in_deviations(checked, a) > in_deviations(checked, b);
  });
  return dofs;
}

/// "yaw is off by +0.42° (9.1 standard deviations)".
std::string dof_text(const CheckedSensor& checked, int dof) {
  return kDofNames.at(static_cast<std::size_t>(dof)) + " is off by " +
         length_text(dof, checked.difference(dof)) + " (" +
         fixed_number(in_deviations(checked, dof), 1) + " standard deviations)";
}

/// The degrees of freedom in which the given pose is wrong.
std::string off_text(const CheckedSensor& checked) {
  std::string text;
  for (const int dof : by_deviations(checked)) {
    if (in_deviations(checked, dof) < kNamedDeviations) break;
    text += (text.empty() ? "" : ", ") + dof_text(checked, dof);
  }
  // Correlated errors may be significant jointly but not individually.
  return text.empty() ? dof_text(checked, by_deviations(checked).front()) +
                            ", and more together with the other degrees of freedom"
                      : text;
}

/// The degrees of freedom that are too uncertain to judge: "x (±0.4 m)".
std::string uncertain_text(const CheckedSensor& checked) {
  std::string text;
  for (int i = 0; i < 6; ++i) {
    const bool is_angle = is_rotation(static_cast<Dof>(i));
    const double deviation = checked.deviations(i);
    if (deviation <= (is_angle ? kMaxDeviation_rad : kMaxDeviation_m)) continue;
    text += (text.empty() ? "" : ", ") + kDofNames.at(static_cast<std::size_t>(i)) + " (±" +
            (is_angle ? fixed_number(deg_from_rad(deviation), 1) + "°"
                      : fixed_number(deviation, 2) + " m") +
            ")";
  }
  return text;
}

std::string distance_text(const CheckedSensor& checked) {
  return fixed_number(checked.distance, 1) + " standard deviations";
}

/// Judges by an accepted optimum that was found without the given pose.
void judge(CheckedSensor& checked) {
  const std::string uncertain = uncertain_text(checked);
  if (checked.distance > kWrongDistance) {
    checked.judgement = PoseJudgement::wrong;
    checked.finding = off_text(checked);
  } else if (!uncertain.empty()) {
    checked.finding = "the clouds do not constrain " + uncertain +
                      "; along the others the pose is within " + distance_text(checked) +
                      " of the optimum";
  } else {
    checked.judgement = PoseJudgement::right;
    checked.finding = "within " + distance_text(checked) + " of the optimum; most of all, " +
                      dof_text(checked, by_deviations(checked).front());
  }
}

/// Judges by an optimum that was accepted only near the given pose.
void judge_near(CheckedSensor& checked) {
  if (checked.distance > kWrongDistance) {
    checked.judgement = PoseJudgement::wrong;
    checked.finding = off_text(checked) + ", from the best pose near it";
  } else {
    checked.finding = "within " + distance_text(checked) +
                      " of the best pose near it, but without it the calibration is rejected: "
                      "another pose may be the true one";
  }
}

}  // namespace

const char* name_of(PoseJudgement judgement) {
  switch (judgement) {
    case PoseJudgement::right:
      return "right";
    case PoseJudgement::wrong:
      return "wrong";
    case PoseJudgement::undecidable:
      break;
  }
  return "undecidable";
}

CheckedSensor check_sensor(const CalibratedSensor& from_nothing,
                           const CalibratedSensor* near_given) {
  CheckedSensor checked;
  checked.sensor = from_nothing.sensor;
  checked.given = from_nothing.nominal;
  if (!checked.given) {
    checked.finding = "no pose was given for it";
    return checked;
  }
  if (from_nothing.is_accepted) {
    set_optimum(checked, from_nothing);
    judge(checked);
    return checked;
  }
  checked.reasons = from_nothing.reasons;
  if (near_given != nullptr && near_given->is_accepted) {
    set_optimum(checked, *near_given);
    judge_near(checked);
  } else {
    checked.finding = "the calibration is rejected, so there is nothing to compare with";
  }
  return checked;
}

std::vector<CheckedSensor> check_rig(const CalibratedRig& from_nothing,
                                     const std::optional<CalibratedRig>& near_given) {
  std::vector<CheckedSensor> sensors;
  for (const CalibratedSensor& sensor : from_nothing.sensors) {
    const CalibratedSensor* near = nullptr;
    if (near_given) {
      for (const CalibratedSensor& other : near_given->sensors) {
        if (other.sensor == sensor.sensor) near = &other;
      }
    }
    sensors.push_back(check_sensor(sensor, near));
  }
  return sensors;
}

}  // namespace croon

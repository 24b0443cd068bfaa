#include "framework/registration/icp_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/spatial/evenly_spaced.hpp"
#include "framework/spatial/tracked_neighbours.hpp"

namespace croon {
namespace {

/// Finds the correspondences of source points at a pose.
class Matcher {
 public:
  Matcher(const Cloud& target, const Cloud& source, const CorrespondenceRule& rule)
      : target_(target),
        source_(source),
        rule_(rule),
        neighbours_(target, source.points().size()),
        target_normals_(rule.target_normals > 0 ? &target.normals(rule.target_normals) : nullptr),
        source_normals_(rule.source_normals > 0 ? &source.normals(rule.source_normals) : nullptr) {}

  /// The correspondence of source point `index`; false if it has none.
  bool match(int index, const RigidTransform& T, float max_distance_m, Correspondence& pair) {
    pair.arm = T.rotation * source_.points()[index].cast<double>();
    const Eigen::Vector3d point = pair.arm + T.translation;
    const Neighbour nearest = neighbours_.nearest(index, point.cast<float>(), max_distance_m);
    if (!nearest) return false;
    pair.offset = point - target_.points()[nearest.index].cast<double>();
    if (target_normals_ != nullptr) {
      const LocalShape shape = target_normals_->at(nearest.index);
      if (shape.normal.isZero()) return false;
      pair.target_normal = shape.normal.cast<double>();
      pair.target_variation = shape.surface_variation;
    }
    if (source_normals_ != nullptr) {
      const LocalShape shape = source_normals_->at(index);
      if (shape.normal.isZero()) return false;
      pair.source_normal = T.rotation * shape.normal.cast<double>();
    }
    const bool both = target_normals_ != nullptr && source_normals_ != nullptr;
    return !both || pair.target_normal.dot(pair.source_normal) >= rule_.min_normal_cosine;
  }

 private:
  const Cloud& target_;
  const Cloud& source_;
  const CorrespondenceRule& rule_;
  TrackedNeighbours neighbours_;
  const Normals* target_normals_;
  const Normals* source_normals_;
};

/// The sums over evenly spaced source points at one pose.
struct Linearised {
  NormalEquations equations;
  int points = 0;
  int correspondences = 0;
};

class Loop {
  static constexpr std::size_t kBlock = 256;

 public:
  Loop(const Cloud& target, const Cloud& source, const IcpOptions& options,
       const CorrespondenceRule& rule, const Linearise& linearise)
      : options_(options),
        matcher_(target, source, rule),
        select_(rule.select),
        linearise_(linearise),
        kernel_(options.kernel, options.kernel_width_m),
        source_size_(static_cast<int>(source.points().size())) {}

  /// Converges at one distance with at most `max_points` of the source.
  void run(Registration& outcome, double max_distance_m, int max_points) {
    outcome.converged = false;
    for (int i = 0; i < options_.max_iterations && !outcome.converged; ++i) {
      const Linearised sums = linearised(outcome.T_target_source, max_distance_m, max_points);
      const Vector6d step = sums.equations.step();
      outcome.T_target_source = stepped(outcome.T_target_source, step);
      outcome.converged = step.head<3>().norm() <= rad_from_deg(options_.rotation_tolerance_deg) &&
                          step.tail<3>().norm() <= options_.translation_tolerance_m;
      ++outcome.iterations;
    }
  }

  /// Evaluates the solution without moving it: residuals, inliers, information.
  void judge(Registration& outcome, double max_distance_m) {
    note(linearised(outcome.T_target_source, max_distance_m, source_size_), outcome);
  }

 private:
  Linearised linearised(const RigidTransform& T, double max_distance_m, int max_points) {
    Linearised sums;
    sums.points = std::min(max_points, source_size_);
    // Blocks stay in the cache; a selection needs all correspondences at once.
    const std::size_t block = select_ ? std::numeric_limits<std::size_t>::max() : kBlock;
    Correspondences pairs;
    const auto add = [&] {
      if (select_) select_(pairs);
      linearise_(pairs, kernel_, sums.equations);
      sums.correspondences += static_cast<int>(pairs.size());
      pairs.clear();
    };
    Correspondence pair;
    for (int i = 0; i < sums.points; ++i) {
      const auto index = static_cast<int>(evenly_spaced_index(i, source_size_, sums.points));
      if (!matcher_.match(index, T, static_cast<float>(max_distance_m), pair)) continue;
      pairs.push_back(pair);
      if (pairs.size() == block) add();
    }
    add();
    if (sums.correspondences < options_.min_correspondences) {
      throw StageError("only " + std::to_string(sums.correspondences) + " of " +
                       std::to_string(sums.points) + " points have a correspondence within " +
                       params::value_json(max_distance_m) + " m");
    }
    return sums;
  }

  static void note(const Linearised& sums, Registration& outcome) {
    const NormalEquations& equations = sums.equations;
    outcome.information = equations.full_information();
    outcome.correspondences = sums.correspondences;
    outcome.inlier_ratio = static_cast<double>(sums.correspondences) / sums.points;
    outcome.rmse_m =
        equations.weight_sum > 0.0
            ? std::sqrt(std::max(0.0, equations.weighted_square_sum) / equations.weight_sum)
            : 0.0;
  }

  const IcpOptions& options_;
  Matcher matcher_;
  const SelectCorrespondences& select_;
  const Linearise& linearise_;
  RobustKernel kernel_;
  int source_size_;
};

}  // namespace

Linearise point_to_plane_linearisation() {
  return for_each_correspondence(
      [](const Correspondence& pair, const RobustKernel& kernel, NormalEquations& equations) {
        const double residual = pair.target_normal.dot(pair.offset);
        equations.add(plane_jacobian(pair.arm, pair.target_normal), residual,
                      kernel.weight(residual * residual));
      });
}

Registration iterate_icp(const Cloud& target, const Cloud& source, const RigidTransform& start,
                         const IcpOptions& options, const CorrespondenceRule& rule,
                         const Linearise& linearise) {
  if (target.empty() || source.empty()) throw StageError("a cloud to be registered is empty");
  Loop loop(target, source, options, rule, linearise);
  Registration outcome;
  outcome.T_target_source = start;
  const int all = static_cast<int>(source.points().size());
  for (std::size_t i = 0; i < options.max_distances_m.size(); ++i) {
    const bool is_last = i + 1 == options.max_distances_m.size();
    loop.run(outcome, options.max_distances_m[i], is_last ? all : options.max_coarse_points);
  }
  loop.judge(outcome, options.max_distances_m.back());
  return outcome;
}

}  // namespace croon

#pragma once

#include <memory>
#include <vector>

#include "framework/params/slot.hpp"
#include "framework/params/table.hpp"
#include "framework/registration/sensor_view.hpp"
#include "framework/stage/hypotheses.hpp"
#include "framework/stage/icp.hpp"
#include "framework/stage/preprocessor.hpp"
#include "framework/stage/step.hpp"

namespace croon {

/// How global searches choose between the poses that they propose; common to all of them, so that
/// they differ only in their proposals. A search's own parameters derive from this and its table
/// inherits hypothesis_choice_table().
struct HypothesisChoice {
  params::Slot<Preprocessor> thinning;  ///< Of the clouds with which poses are scored.
  params::Slot<Icp> icp;                ///< Refines a pose before it is scored.
  bool use_start = false;
  double max_rotation_deg = 45.0;
  double max_translation_m = 0.5;

  /// The data flow of the stage; it provides `hypotheses`.
  params::DataFlow flow() const;
};

/// The rows of HypothesisChoice.
const params::Table<HypothesisChoice>& hypothesis_choice_table();

/// Sorts poses by score, best first; ties keep their order.
void sort_by_score(std::vector<Hypothesis>& poses);

/// Throws StageError if the cloud is empty; `whose` is its owner in the message.
void require_points(const Cloud& cloud, const char* whose);

/// The view of a cloud for judging poses (see shared_view), computed once. Throws StageError like
/// require_points.
std::shared_ptr<const SensorView> view_of(const Cloud& cloud, const HypothesisChoice& choice,
                                          const char* whose);

/// The estimate at the best of `proposed` (their scores are ignored) and, with `use_start`, of the
/// start: each pose is refined, scored by pose_evidence, and discarded if it is near a better one
/// or, with `use_start`, far from the start. The remaining poses become the extra `hypotheses`; the
/// diagnostics are their number and the two best scores. Throws StageError if none remains.
Estimate at_best(Estimate estimate, const std::vector<Hypothesis>& proposed,
                 const HypothesisChoice& choice);

}  // namespace croon

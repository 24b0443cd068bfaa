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

/// How every global search chooses between the poses that it proposes, so that searches differ in
/// what they propose alone. A search's own parameters derive from this and its table inherits
/// hypothesis_choice_table().
struct HypothesisChoice {
  params::Slot<Preprocessor> thinning;  ///< Of the clouds that poses are judged by.
  params::Slot<Icp> icp;                ///< Refines a pose before it is judged.
  bool use_start = false;
  double max_rotation_deg = 45.0;
  double max_translation_m = 0.5;

  /// What the stage needs and gives: `hypotheses`.
  params::DataFlow flow() const;
};

/// The rows of HypothesisChoice.
const params::Table<HypothesisChoice>& hypothesis_choice_table();

/// Poses by score, best first; of equals the first remains the first.
void sort_by_score(std::vector<Hypothesis>& poses);

/// Throws StageError if the cloud is empty; `whose` names it.
void require_points(const Cloud& cloud, const char* whose);

/// What a cloud's poses are judged by (see shared_view), made once. Throws StageError as
/// require_points does.
std::shared_ptr<const SensorView> view_of(const Cloud& cloud, const HypothesisChoice& choice,
                                          const char* whose);

/// The estimate at the best of `proposed` (their scores do not count): each pose is refined, judged
/// by pose_evidence, and dropped if it is near a better one or, with `use_start`, far from the
/// start. The others become the extra `hypotheses`; diagnostics are their number and the two best
/// scores. Throws StageError if none remains.
Estimate at_best(Estimate estimate, const std::vector<Hypothesis>& proposed,
                 const HypothesisChoice& choice);

}  // namespace croon

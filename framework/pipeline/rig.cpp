#include "framework/pipeline/rig.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <stdexcept>

#include "framework/base/error.hpp"
#include "framework/base/threads.hpp"
#include "framework/pipeline/own_time.hpp"
#include "framework/stage/reasons.hpp"
#include "framework/stage/rig_step.hpp"

namespace croon {
namespace {

const RigStep* rig_step(const NamedStep& named) {
  return dynamic_cast<const RigStep*>(&*named.step);
}

template <class A, class B>
bool is_of_same_sensor(const A& a, const B& b) {
  return a.target == b.target && a.source == b.source;
}

/// The estimates of `members` for a step, with their diagnostics cleared.
std::vector<RigEstimate> estimates_of(const std::vector<RigMember*>& members, const Rig& rig) {
  std::vector<RigEstimate> estimates;
  for (const RigMember* const member : members) {
    estimates.push_back({member->scene, member->target, member->source, member->result.estimate,
                         member->result.failure});
    estimates.back().estimate.diagnostics.clear();
    estimates.back().scenes =
        static_cast<std::size_t>(std::count_if(rig.begin(), rig.end(), [&](const RigMember& other) {
          return is_of_same_sensor(other, *member);
        }));
  }
  return estimates;
}

/// A pose that is not finite is a failure, so that it does not spoil the other scenes of its
/// sensor. The only scene of a sensor is judged at the end of its trial.
void fail_if_not_finite(RigMember& member, const std::string& step, const Rig& rig) {
  const RigidTransform& T = member.result.estimate.T_target_source;
  if (!member.result.failure.empty() || (T.rotation.allFinite() && T.translation.allFinite())) {
    return;
  }
  const auto is_other = [&](const RigMember& other) {
    return &other != &member && is_of_same_sensor(other, member);
  };
  if (std::any_of(rig.begin(), rig.end(), is_other)) {
    member.result.failure = step + ": the pose is not finite";
  }
}

/// Clears the failure of `member`, and adds the records of the steps that it missed, without time,
/// up to those of `other`.
void repair(RigMember& member, const RigMember& other) {
  member.result.failure.clear();
  std::vector<StepRecord>& records = member.result.records;
  for (std::size_t i = records.size(); i < other.result.records.size(); ++i) {
    records.push_back({other.result.records[i].name, 0.0, {}, std::nullopt});
  }
}

/// Updates `member` with the estimate that the step `name` computed in `seconds`.
void update_member(RigMember& member, const std::string& name, RigEstimate&& adjusted,
                   double seconds) {
  Estimate before = std::exchange(member.result.estimate, std::move(adjusted.estimate));
  Estimate& after = member.result.estimate;
  const bool is_computed = after.information && after.information != before.information;
  member.result.records.push_back(
      {name, seconds, after.diagnostics, is_computed ? after.information : std::nullopt});
  if (after.rejection) after.rejection = with_name(before.rejection, *after.rejection, name);
  if (adjusted.failure.empty()) return;
  after = std::move(before);
  member.result.failure = name + ": " + adjusted.failure;
}

void adjust_all(Rig& rig, const RigStep& step, const std::string& name, const StreamKey& key) {
  std::vector<RigMember*> seen;
  const RigMember* live = nullptr;
  for (RigMember& member : rig) {
    const bool is_live = member.result.failure.empty();
    if (is_live && live == nullptr) live = &member;
    // A cloud that could not be read is null.
    const bool has_clouds = member.result.estimate.target && member.result.estimate.source;
    if (is_live || (step.sees_failures() && has_clouds)) seen.push_back(&member);
  }
  if (live == nullptr) return;
  const OwnTime time;
  Rng rng(key.with(name));
  std::vector<RigEstimate> estimates = estimates_of(seen, rig);
  try {
    step.adjust(estimates, rng);
  } catch (const StageError& error) {
    estimates = estimates_of(seen, rig);
    for (RigEstimate& estimate : estimates) {
      if (estimate.failure.empty()) estimate.failure = error.what();
    }
  }
  const bool is_kept =
      std::equal(estimates.begin(), estimates.end(), seen.begin(), seen.end(),
                 [](const RigEstimate& estimate, const RigMember* member) {
                   return estimate.scene == member->scene && is_of_same_sensor(estimate, *member);
                 });
  if (!is_kept) {
    throw std::logic_error("the step \"" + name + "\" changed the number or order of estimates");
  }
  const auto stays_failed = [&](std::size_t i) {
    return !seen[i]->result.failure.empty() && !estimates[i].failure.empty();
  };
  std::size_t recorded = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) recorded += stays_failed(i) ? 0 : 1;
  const double seconds = time.seconds() / static_cast<double>(recorded);
  const RigMember live_before = *live;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (stays_failed(i)) {
      seen[i]->result.failure = estimates[i].failure;
      continue;
    }
    if (!seen[i]->result.failure.empty()) repair(*seen[i], live_before);
    update_member(*seen[i], name, std::move(estimates[i]), seconds);
  }
}

/// 0 if the result is not rejected, 1 if it is rejected, 2 if it failed.
int rank(const RigMember& member) {
  if (!member.result.failure.empty()) return 2;
  return member.result.estimate.rejection ? 1 : 0;
}

}  // namespace

bool has_rig_step(const Pipeline& pipeline) {
  return std::any_of(pipeline.begin(), pipeline.end(),
                     [](const NamedStep& step) { return rig_step(step) != nullptr; });
}

void advance(Rig& rig, const NamedStep& named, const StreamKey& key) {
  if (const RigStep* const step = rig_step(named)) {
    adjust_all(rig, *step, named.name, key);
  } else {
    for_each_in_parallel(rig.size(), [&](std::size_t i) {
      // Isolated: a thread that waits inside a step must not start another member, whose time would
      // count as this one's.
      tbb::this_task_arena::isolate([&] { advance(rig[i].result, named, rig[i].key); });
    });
  }
  for (RigMember& member : rig) fail_if_not_finite(member, named.name, rig);
}

void run_pipeline(const Pipeline& pipeline, Rig& rig, const StreamKey& key) {
  for (const NamedStep& step : pipeline) advance(rig, step, key);
}

PipelineResult result_of_sensor(const std::vector<const RigMember*>& members) {
  const auto best =
      std::min_element(members.begin(), members.end(),
                       [](const RigMember* a, const RigMember* b) { return rank(*a) < rank(*b); });
  PipelineResult result = (*best)->result;
  for (const RigMember* const member : members) {
    const std::vector<StepRecord>& records = member->result.records;
    for (std::size_t i = result.records.size(); i < records.size(); ++i) {
      result.records.push_back({records[i].name, 0.0, {}, std::nullopt});
    }
  }
  for (std::size_t i = 0; i < result.records.size(); ++i) {
    double& seconds = result.records[i].seconds = 0.0;
    for (const RigMember* const member : members) {
      const std::vector<StepRecord>& records = member->result.records;
      if (i < records.size()) seconds += records[i].seconds;
    }
  }
  return result;
}

}  // namespace croon

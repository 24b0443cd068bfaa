#pragma once

#include <set>
#include <string>
#include <vector>

#include "experiments/run/trial_plan.hpp"

namespace croon::experiments {

/// The channels of any cloud that a step of the variants of `experiment` needs.
std::set<std::string> needed_channels(const Experiment& experiment);

/// Throws InputError if a cloud lacks a channel that a step of the variants of `selection` needs: a
/// fault for each sensor and channel, with the first file that lacks it. Clouds whose channels are
/// unknown before they are read are accepted; the step then fails.
void check_channels(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                    const Selection& selection);

}  // namespace croon::experiments

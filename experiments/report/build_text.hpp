#pragma once

#include <string>
#include <vector>

#include "experiments/store/build.hpp"

namespace croon::experiments {

/// The first digits of a commit; a suffix "-dirty" is kept.
std::string short_commit(const std::string& commit);

/// Remarks on the builds that made the trials, one plain-text sentence each: the commit and program
/// of each build if there were several, and the folders of stages from outside the tree. Empty for
/// one build without such stages.
std::vector<std::string> build_sentences(const std::vector<Build>& builds);

}  // namespace croon::experiments

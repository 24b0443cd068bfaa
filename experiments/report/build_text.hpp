#pragma once

#include <string>
#include <vector>

#include "experiments/store/build.hpp"

namespace croon::experiments {

/// The first digits of a commit; the suffix "-dirty" stays.
std::string short_commit(const std::string& commit);

/// What a reader has to know of the builds that made the trials besides the commit of one: if there
/// were several, each by commit and program; and the folders of stages from outside the tree. Plain
/// text, a sentence each; none for one build without such stages.
std::vector<std::string> build_sentences(const std::vector<Build>& builds);

}  // namespace croon::experiments

#pragma once

#include <string>
#include <vector>

#include "framework/stage/leaf_scorer.hpp"
#include "test/support/stages.hpp"

namespace croon::test {

/// The names of the registered volume scorers that count leaves.
inline std::vector<std::string> leaf_scorer_names() {
  std::vector<std::string> names;
  for (const std::string& name : registry().names(VolumeScorer::kKind)) {
    const auto scorer = stage<VolumeScorer>(R"({"type": ")" + name + R"("})");
    if (dynamic_cast<const LeafScorer*>(&*scorer) != nullptr) names.push_back(name);
  }
  return names;
}

}  // namespace croon::test

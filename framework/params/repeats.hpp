#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "framework/params/node.hpp"

namespace croon::params {

/// Notes a fault for each repeated name in `names`, the list at `key` of `node`.
inline void refuse_repeats(const std::vector<std::string>& names, const Node& node,
                           const std::string& key) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto at = names.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(names.begin(), at, *at) == at) continue;
    node.member(key).element(i).fault("expected each name once, found \"" + *at + "\" again");
  }
}

}  // namespace croon::params

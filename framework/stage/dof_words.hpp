#pragma once

#include "framework/geometry/dof.hpp"
#include "framework/params/choice.hpp"

namespace croon {

/// The words for the degrees of freedom, for parameters that list some.
inline const params::Words<Dof>& dof_words() {
  static const params::Words<Dof> words = [] {
    params::Words<Dof> all;
    for (std::size_t i = 0; i < kDofNames.size(); ++i) {
      all.emplace_back(kDofNames[i], static_cast<Dof>(i));
    }
    return all;
  }();
  return words;
}

}  // namespace croon

#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace croon::test {

/// The folder of the authors' samples: CROON_DATA, else shared/data beside the checkout, else data/
/// in it; empty if there is none.
std::filesystem::path data_root();

}  // namespace croon::test

/// Ends a test that wants the authors' samples and does not find them; it says so and counts as
/// skipped.
#define CROON_SKIP_WITHOUT_DATA()                                                      \
  if (croon::test::data_root().empty()) {                                              \
    GTEST_SKIP() << "the authors' samples are not here; set CROON_DATA to their root"; \
  }                                                                                    \
  static_assert(true, "")

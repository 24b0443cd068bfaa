#include "experiments/analysis/paired_tests.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "test/experiments/analysis/simulated_experiments.hpp"

namespace croon::experiments {
namespace {

using test::DrawnExperiment;
using test::MadeUp;
using test::share_significant;

double mcnemar_p_of(const DrawnExperiment& experiment) {
  return mcnemar_p(experiment.only_base, experiment.only_variant);
}

TEST(McNemar, KnownValues) {
  EXPECT_EQ(mcnemar_p(0, 0), 1.0);
  EXPECT_EQ(mcnemar_p(7, 7), 1.0);
  EXPECT_DOUBLE_EQ(mcnemar_p(1, 9), 2.0 * (1.0 + 10.0) / 1024.0);
  EXPECT_DOUBLE_EQ(mcnemar_p(0, 6), 2.0 / 64.0);
  // Agresti (1990), page 350; the example of R's mcnemar.test: binom.test(86, 236).
  EXPECT_NEAR(mcnemar_p(86, 150), 3.716e-5, 5e-9);
  EXPECT_THROW(mcnemar_p(-1, 2), std::logic_error);
}

TEST(McNemar, LargeCounts) {
  // sqrt(n) = 1000: z = 1.999 with the correction for continuity.
  EXPECT_NEAR(mcnemar_p(499000, 501000), 0.045610, 1e-5);
  EXPECT_LT(mcnemar_p(100000, 900000), 1e-300);
}

TEST(McNemar, SwappedSidesHaveTheSameP) {
  for (int a = 0; a < 20; ++a) {
    for (int b = 0; b < 20; ++b) EXPECT_EQ(mcnemar_p(a, b), mcnemar_p(b, a));
  }
}

TEST(McNemar, KeepsItsLevel) {
  MadeUp few, many, failing;
  few.scenes = 12;
  many.scenes = 200;
  failing.failure_ratio = 0.3;
  for (const MadeUp& null : {few, many, failing}) {
    EXPECT_LE(share_significant(null, mcnemar_p_of), test::kMaxFalsePositives);
  }
  EXPECT_GE(share_significant(many, mcnemar_p_of), 0.02);
}

TEST(McNemar, FindsAnEffect) {
  MadeUp worse;
  worse.scenes = 100;
  worse.variant_failures = 0.5;
  EXPECT_GE(share_significant(worse, mcnemar_p_of), 0.9);
}

}  // namespace
}  // namespace croon::experiments

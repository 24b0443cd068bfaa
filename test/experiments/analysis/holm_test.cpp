#include "experiments/analysis/paired_tests.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "test/support/random_geometry.hpp"

namespace croon::experiments {
namespace {

TEST(Holm, KnownValues) {
  // R: p.adjust(c(0.03, 0.01, 0.04, 0.02), "holm").
  const std::vector<double> corrected = holm({0.03, 0.01, 0.04, 0.02});
  const std::vector<double> expected = {0.06, 0.04, 0.06, 0.06};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_DOUBLE_EQ(corrected[i], expected[i]);
  EXPECT_EQ(holm({0.7, 0.6}), (std::vector<double>{1.0, 1.0}));
  EXPECT_EQ(holm({0.03}), (std::vector<double>{0.03}));
  EXPECT_TRUE(holm({}).empty());
}

TEST(Holm, KeepsTheOrderAndIsBetweenPAndBonferroni) {
  Rng rng = croon::test::test_rng();
  for (int i = 0; i < 100; ++i) {
    std::vector<double> p;
    for (int k = 0; k < 20; ++k) p.push_back(0.1 * rng.uniform());
    const std::vector<double> corrected = holm(p);
    for (std::size_t a = 0; a < p.size(); ++a) {
      EXPECT_GE(corrected[a], p[a]);
      EXPECT_LE(corrected[a], std::min(1.0, 20.0 * p[a]));
      for (std::size_t b = 0; b < p.size(); ++b) {
        EXPECT_TRUE(p[a] >= p[b] || corrected[a] <= corrected[b]);
      }
    }
  }
}

TEST(Holm, AnyFalseFindingAmongManyIsRare) {
  Rng rng = croon::test::test_rng();
  constexpr int kFamilies = 4000;
  int with_false = 0;
  for (int i = 0; i < kFamilies; ++i) {
    std::vector<double> p = {1e-9, 1e-6};  // Two that are true, which step the others down.
    for (int k = 0; k < 15; ++k) p.push_back(rng.uniform());
    const std::vector<double> corrected = holm(p);
    with_false += *std::min_element(corrected.begin() + 2, corrected.end()) < 0.05;
    EXPECT_LT(corrected[1], 0.05);
  }
  // 5 % and three standard deviations.
  EXPECT_LE(with_false, kFamilies * (0.05 + 3.0 * 0.00345));
  EXPECT_GE(with_false, kFamilies * 0.03);
}

}  // namespace
}  // namespace croon::experiments

#include "framework/registration/icp_options.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace croon {
namespace {

TEST(RobustKernel, IsOneAtZeroAndNeverGrows) {
  for (const auto& [name, value] : kKernelWords) {
    const RobustKernel kernel(value, 0.1);
    EXPECT_EQ(kernel.weight(0.0), 1.0) << name;
    double last = 1.0;
    for (double r = 0.0; r < 5.0; r += 0.01) {
      const double weight = kernel.weight(r * r);
      EXPECT_LE(weight, last) << name << " at " << r;
      EXPECT_GT(weight, 0.0) << name << " at " << r;
      last = weight;
    }
  }
}

TEST(RobustKernel, WeighsAsTheTableOfZhang1997) {
  const double k = 0.3;
  for (double r = 0.05; r < 2.0; r += 0.05) {
    const double s = r * r;
    EXPECT_EQ(RobustKernel(Kernel::none, k).weight(s), 1.0);
    EXPECT_NEAR(RobustKernel(Kernel::huber, k).weight(s), r <= k ? 1.0 : k / r, 1e-12);
    EXPECT_NEAR(RobustKernel(Kernel::cauchy, k).weight(s), 1.0 / (1.0 + s / (k * k)), 1e-12);
    EXPECT_NEAR(RobustKernel(Kernel::geman_mcclure, k).weight(s), std::pow(k * k / (k * k + s), 2),
                1e-12);
  }
}

}  // namespace
}  // namespace croon

// The functions that framework/base/libm.hpp puts in place of those of the C library.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

constexpr int kArguments = 20000;

struct Arguments {
  double from = 0.0;
  double to = 0.0;
};

/// A function of <cmath> for double, the one of the same name for long double, and arguments.
struct Unary {
  std::string name;
  double (*computed)(double);
  long double (*precise)(long double);
  std::vector<Arguments> arguments;
};

/// `function` as pointers to both overloads.
#define CROON_UNARY(function, ...)                                                                 \
  Unary {                                                                                          \
#function,                                                                                     \
        [](double x) { return std::function(x); }, [](long double x) { return std::function(x); }, \
    {                                                                                              \
      __VA_ARGS__                                                                                  \
    }                                                                                              \
  }

/// The distance between the doubles beside `value`.
double ulp_of(double value) {
  const double size = std::max(std::abs(value), std::numeric_limits<double>::min());
  return std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
}

void expect_close(double computed, long double precise, const std::string& call) {
  const auto rounded = static_cast<double>(precise);
  EXPECT_LE(std::abs(static_cast<long double>(computed) - precise), 2.0L * ulp_of(rounded))
      << call << " is " << computed << " instead of " << rounded;
}

TEST(Libm, FunctionsOfOneArgumentAreWithinTwoUlp) {
  const std::vector<Unary> functions = {
      CROON_UNARY(sin, {-4, 4}, {-1e6, 1e6}),
      CROON_UNARY(cos, {-4, 4}, {-1e6, 1e6}),
      CROON_UNARY(tan, {-4, 4}),
      CROON_UNARY(asin, {-1, 1}),
      CROON_UNARY(acos, {-1, 1}),
      CROON_UNARY(atan, {-1, 1}, {-1e3, 1e3}),
      CROON_UNARY(sinh, {-3, 3}),
      CROON_UNARY(cosh, {-3, 3}),
      CROON_UNARY(tanh, {-3, 3}),
      CROON_UNARY(asinh, {-9, 9}),
      CROON_UNARY(acosh, {1, 9}),
      CROON_UNARY(atanh, {-0.99, 0.99}),
      CROON_UNARY(exp, {-1, 1}, {-500, 500}),
      CROON_UNARY(exp2, {-500, 500}),
      CROON_UNARY(expm1, {-1, 1}, {-9, 9}),
      CROON_UNARY(log, {0, 2}, {0, 1e9}),
      CROON_UNARY(log2, {0, 2}, {0, 1e9}),
      CROON_UNARY(log10, {0, 2}, {0, 1e9}),
      CROON_UNARY(log1p, {-0.9, 1}),
      CROON_UNARY(cbrt, {-1e3, 1e3}),
      CROON_UNARY(erf, {-3, 3}),
      CROON_UNARY(erfc, {-3, 9}),
      CROON_UNARY(tgamma, {0.1, 50}),
      CROON_UNARY(lgamma, {3, 1e3}),
  };
  Rng rng = test::test_rng(1);
  for (const Unary& function : functions) {
    for (const Arguments& interval : function.arguments) {
      for (int i = 0; i < kArguments; ++i) {
        const double x = rng.uniform(interval.from, interval.to);
        expect_close(function.computed(x), function.precise(x),
                     function.name + "(" + std::to_string(x) + ")");
        if (HasFailure()) return;
      }
    }
  }
}

TEST(Libm, FunctionsOfTwoArgumentsAreWithinTwoUlp) {
  Rng rng = test::test_rng(2);
  for (int i = 0; i < kArguments; ++i) {
    const double x = rng.uniform(-50.0, 50.0);
    const double y = rng.uniform(-50.0, 50.0);
    const long double long_x = x;
    const std::string arguments = "(" + std::to_string(x) + ", " + std::to_string(y) + ")";
    expect_close(std::atan2(x, y), std::atan2(long_x, static_cast<long double>(y)),
                 "atan2" + arguments);
    expect_close(std::hypot(x, y), std::hypot(long_x, static_cast<long double>(y)),
                 "hypot" + arguments);
    expect_close(std::pow(std::abs(x), y), std::pow(std::abs(long_x), static_cast<long double>(y)),
                 "pow" + arguments);
  }
}

TEST(Libm, EdgesAreThoseOfTheStandard) {
  const double infinity = std::numeric_limits<double>::infinity();
  // Volatile, or the compiler computes the results itself.
  volatile double zero = 0.0;
  volatile double one = 1.0;
  EXPECT_EQ(std::log(zero), -infinity);
  EXPECT_TRUE(std::isnan(std::log(-one)));
  EXPECT_EQ(std::exp(-infinity), 0.0);
  EXPECT_EQ(std::exp(1000.0 * one), infinity);
  EXPECT_EQ(std::atan2(zero, zero), 0.0);
  EXPECT_EQ(std::atan2(zero, -one), std::acos(-one));
  EXPECT_TRUE(std::signbit(std::sin(-zero)));
  EXPECT_EQ(std::cos(zero), 1.0);
  EXPECT_EQ(std::acos(one), 0.0);
  EXPECT_TRUE(std::isnan(std::acos(1.5 * one)));
  EXPECT_EQ(std::pow(zero, zero), 1.0);
  EXPECT_EQ(std::pow(zero, -one), infinity);
  EXPECT_EQ(std::hypot(3.0 * one, 4.0 * one), 5.0);
  EXPECT_TRUE(std::isnan(std::sin(infinity * one)));
}

}  // namespace
}  // namespace croon

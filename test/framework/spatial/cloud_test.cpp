#include "framework/spatial/cloud.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "framework/base/error.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

TEST(Cloud, MakesAThingOnceForAllThreads) {
  Rng rng = test::test_rng();
  const Cloud cloud(test::random_cloud(rng, 100, 1.0), StreamKey(1));
  std::atomic<int> made{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&] {
      const auto thing = cloud.once<int>("thing", [&] {
        ++made;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        return std::make_shared<const int>(7);
      });
      EXPECT_EQ(*thing, 7);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(made, 1);
  ASSERT_EQ(cloud.timings().size(), 1u);
  EXPECT_EQ(cloud.timings()[0].what, "thing");
}

TEST(Cloud, RemembersWhatCouldNotBeMade) {
  const Cloud cloud({}, StreamKey(1));
  int tried = 0;
  const auto make = [&]() -> std::shared_ptr<const int> {
    ++tried;
    throw StageError("no");
  };
  EXPECT_THROW(cloud.once<int>("thing", make), StageError);
  EXPECT_THROW(cloud.once<int>("thing", make), StageError);
  EXPECT_EQ(tried, 1);
}

TEST(Cloud, TimesNestedWorkOnceAndDerivedCloudsToo) {
  const Cloud cloud({}, StreamKey(1));
  const double before = seconds_spent_on_shared_work();
  cloud.once<int>("outer", [&] {
    cloud.once<int>("inner", [] {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      return std::make_shared<const int>(1);
    });
    return std::make_shared<const int>(2);
  });
  const double spent = seconds_spent_on_shared_work() - before;
  cloud.derived({}, "part")->kd_tree();
  const std::vector<OnceTiming> timings = cloud.timings();
  ASSERT_EQ(timings.size(), 3u);
  EXPECT_EQ(timings[0].what, "inner");
  EXPECT_EQ(timings[1].what, "outer");
  EXPECT_EQ(timings[2].what, "part/kd_tree");
  EXPECT_LT(timings[1].seconds, timings[0].seconds);
  EXPECT_NEAR(timings[0].seconds + timings[1].seconds, spent, 1e-3);
}

TEST(Cloud, CloudsOfOneTrialDoNoSharedWork) {
  const Cloud cloud({}, StreamKey(1));
  const auto part = cloud.derived_in_trial({}, "part");
  const double before = seconds_spent_on_shared_work();
  part->once<int>("slow", [] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return std::make_shared<const int>(1);
  });
  part->derived({}, "of part")->kd_tree();
  EXPECT_EQ(seconds_spent_on_shared_work(), before);
  EXPECT_TRUE(cloud.timings().empty());
  EXPECT_TRUE(part->timings().empty());
  EXPECT_EQ(part->rng("x").bits(), cloud.derived({}, "part")->rng("x").bits());
}

TEST(Cloud, DerivedCloudsDrawFromStreamsOfTheirOwn) {
  const Cloud cloud({}, StreamKey(1));
  const std::uint64_t own = cloud.rng("x").bits();
  EXPECT_EQ(cloud.rng("x").bits(), own);
  EXPECT_NE(cloud.rng("y").bits(), own);
  EXPECT_NE(cloud.derived({}, "part")->rng("x").bits(), own);
}

}  // namespace
}  // namespace croon

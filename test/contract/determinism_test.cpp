// Same input, same seed: the same bits, on one thread, on four, and of four at once.
#include <array>
#include <nlohmann/json.hpp>
#include <thread>

#include "framework/base/threads.hpp"
#include "test/contract/every_stage.hpp"
#include "test/contract/outcome.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::test {
namespace {

CloudPair streets() {
  Rng rng = test_rng(11);
  const Points target = random_street(rng, 4, 4000, 0.01);
  return cloud_pair(target, random_street(rng, 4, 2000, 0.01));
}

class ContractOfBits : public EveryStage {
 protected:
  Outcome outcome_on(const CloudPair& clouds) const {
    return outcome_of(entry().kind, minimal_json(entry()), clouds);
  }

  /// With TBB on `jobs` threads, on clouds of which nothing has been computed yet.
  Outcome outcome_with(int jobs) const {
    Outcome outcome;
    on_threads(jobs, [&] { outcome = outcome_on(streets()); });
    return outcome;
  }
};

TEST_P(ContractOfBits, SameOnOneThreadAndOnFour) {
  const Outcome alone = outcome_with(1);
  EXPECT_EQ(alone.stage_error, "");
  EXPECT_FALSE(alone.numbers.empty());
  EXPECT_EQ(outcome_with(1).bits(), alone.bits()) << "twice on one thread";
  EXPECT_EQ(outcome_with(4).bits(), alone.bits()) << "on four threads";
  const CloudPair shared = streets();
  std::array<Outcome, 4> together;
  std::vector<std::thread> threads;
  for (Outcome& outcome : together) {
    threads.emplace_back([&outcome, &shared, this] { outcome = outcome_on(shared); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Outcome& outcome : together) EXPECT_EQ(outcome.bits(), alone.bits());
}

INSTANTIATE_TEST_SUITE_P(Registry, ContractOfBits, testing::ValuesIn(every_stage({"dataset"})),
                         stage_case_name);

}  // namespace
}  // namespace croon::test

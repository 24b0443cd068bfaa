// Same input, same seed: the same bits, on one thread and on four at once.
#include <array>
#include <nlohmann/json.hpp>
#include <thread>

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
};

TEST_P(ContractOfBits, SameOnOneThreadAndOnFour) {
  const Outcome alone = outcome_on(streets());
  EXPECT_EQ(alone.stage_error, "");
  EXPECT_FALSE(alone.numbers.empty());
  EXPECT_EQ(outcome_on(streets()).bits(), alone.bits()) << "twice on one thread";
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

// Degenerate clouds give a StageError or finite numbers, never a crash, a hang or NaN.
#include <nlohmann/json.hpp>

#include "test/contract/every_stage.hpp"
#include "test/contract/outcome.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::test {
namespace {

constexpr int kPoints = 500;

Points three_points() { return {{1, 0, -2}, {0, 1, -2}, {-1, -1, -2}}; }

Points equal_points() { return Points(kPoints, Eigen::Vector3f(1.0F, 2.0F, 3.0F)); }

Points points_on_a_line() {
  Points cloud;
  for (int i = 0; i < kPoints; ++i) {
    cloud.push_back(0.05F * static_cast<float>(i) * Eigen::Vector3f(1, 2, 3).normalized());
  }
  return cloud;
}

Points points_on_a_plane() {
  Rng rng = test_rng(21);
  Points cloud = random_cloud(rng, kPoints, 10.0);
  for (Eigen::Vector3f& point : cloud) point.z() = -2.0F;
  return cloud;
}

Points street() {
  Rng rng = test_rng(22);
  return random_street(rng, 4, 2 * kPoints, 0.01);
}

Points far_street() {
  Points cloud = street();
  for (Eigen::Vector3f& point : cloud) point += Eigen::Vector3f(1e6F, -1e6F, 1e6F);
  return cloud;
}

class ContractOfClouds : public EveryStage {
 protected:
  void expect_error_or_finite(const std::string& what, const Points& target,
                              const Points& source) const {
    SCOPED_TRACE(what);
    const Outcome outcome =
        outcome_of(entry().kind, minimal_json(entry()), cloud_pair(target, source));
    EXPECT_TRUE(outcome.is_finite());
  }

  /// The cloud against itself, and on either side of a street.
  void expect_no_harm_of(const Points& cloud) const {
    expect_error_or_finite("both", cloud, cloud);
    expect_error_or_finite("as target", cloud, street());
    expect_error_or_finite("as source", street(), cloud);
  }
};

TEST_P(ContractOfClouds, Empty) { expect_no_harm_of({}); }
TEST_P(ContractOfClouds, OnePoint) { expect_no_harm_of({Eigen::Vector3f(1, 2, 3)}); }
TEST_P(ContractOfClouds, ThreePoints) { expect_no_harm_of(three_points()); }
TEST_P(ContractOfClouds, AllPointsEqual) { expect_no_harm_of(equal_points()); }
TEST_P(ContractOfClouds, AllPointsOnALine) { expect_no_harm_of(points_on_a_line()); }
TEST_P(ContractOfClouds, AllPointsOnAPlane) { expect_no_harm_of(points_on_a_plane()); }
TEST_P(ContractOfClouds, AThousandKilometresAway) { expect_no_harm_of(far_street()); }

INSTANTIATE_TEST_SUITE_P(Registry, ContractOfClouds, testing::ValuesIn(every_stage({"dataset"})),
                         stage_case_name);

}  // namespace
}  // namespace croon::test

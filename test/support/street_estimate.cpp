#include "test/support/street_estimate.hpp"

#include "test/support/random_geometry.hpp"

namespace croon::test {

StreetEstimate street_estimate(std::uint64_t seed) {
  Rng rng = test_rng(seed);
  StreetEstimate street;
  street.truth = pose_near(rng, {}, 40.0, 1.0);
  const PointCloud target = random_street(rng, seed, 20000, 0.01);
  const PointCloud source =
      transformed(random_street(rng, seed, 6000, 0.01), street.truth.inverse());
  street.estimate.target = std::make_shared<const Cloud>(target, StreamKey(seed).with("target"));
  street.estimate.source = std::make_shared<const Cloud>(source, StreamKey(seed).with("source"));
  street.estimate.T_target_source = street.truth;
  return street;
}

}  // namespace croon::test

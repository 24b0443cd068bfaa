#include "test/support/street_estimate.hpp"

#include "test/support/random_geometry.hpp"

namespace croon::test {

StreetEstimate street_estimate(std::uint64_t seed) {
  Rng rng = test_rng(seed);
  StreetEstimate street;
  street.truth = pose_near(rng, {}, 40.0, 1.0);
  const StreetPair pair = street_pair(rng, seed, street.truth, 20000, 6000, 0.01);
  const StreamKey key(seed);
  street.estimate.target = std::make_shared<const Cloud>(pair.target, key.with("target"));
  street.estimate.source = std::make_shared<const Cloud>(pair.source, key.with("source"));
  street.estimate.T_target_source = street.truth;
  return street;
}

}  // namespace croon::test

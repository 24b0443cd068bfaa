#include "test/support/street_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "test/support/random_geometry.hpp"

namespace croon::test {

Estimate estimate_of(Points target, Points source, const RigidTransform& T_target_source,
                     std::uint64_t seed) {
  const StreamKey key(seed);
  Estimate estimate;
  estimate.target = std::make_shared<const Cloud>(std::move(target), key.with("target"));
  estimate.source = std::make_shared<const Cloud>(std::move(source), key.with("source"));
  estimate.T_target_source = T_target_source;
  return estimate;
}

double diagnostic(const Estimate& estimate, const std::string& name) {
  for (const auto& [found, value] : estimate.diagnostics) {
    if (found == name) return value;
  }
  ADD_FAILURE() << "no diagnostic " << name;
  return NAN;
}

StreetEstimate street_estimate(std::uint64_t seed) {
  Rng rng = test_rng(seed);
  StreetEstimate street;
  street.truth = pose_near(rng, {}, 40.0, 1.0);
  const StreetPair pair = street_pair(rng, seed, street.truth, 20000, 6000, 0.01);
  street.estimate = estimate_of(pair.target, pair.source, street.truth, seed);
  return street;
}

}  // namespace croon::test

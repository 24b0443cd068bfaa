#pragma once

#include <string>
#include <vector>

#include "framework/params/node.hpp"
#include "registry/claim_keys.hpp"

namespace croon::experiments {

/// What an experiment is held against.
struct Claims {
  std::vector<Expectation> expect;
  std::vector<Quoted> quoted;
};

/// The claims in the keys "expect" and "quoted" of the experiment `root`, whose variants are
/// called `variants` (none where they are faulty). Notes faults in the node.
Claims read_claims(const params::Node& root, const std::vector<std::string>& variants);

/// Canonical JSON text of the claims: `{"expect":[...],"quoted":[...]}`.
std::string claims_json(const Claims& claims);

/// The claims that `claims_json` wrote. `file` is where `text` comes from; throws InputError where
/// it is none.
Claims claims_of(const std::string& text, const std::string& file);

}  // namespace croon::experiments

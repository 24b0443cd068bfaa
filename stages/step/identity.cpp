#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"

namespace croon::stages::step {
namespace {

struct Params {};

class Identity final : public Step {
 public:
  explicit Identity(const Params&) {}

  Estimate advance(Estimate estimate, Rng&) const override { return estimate; }
};

}  // namespace

StageEntry identity() {
  return stage_entry<Identity>("identity", "Leaves the estimate as it is.", "croon",
                               params::Table<Params>{});
}

}  // namespace croon::stages::step

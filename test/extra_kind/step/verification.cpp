#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"
#include "verifier.hpp"

namespace croon::stages::step {
namespace {

struct Params {
  params::Slot<Verifier> verifier;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::slot("verifier", &Params::verifier, R"({"type": "tilt"})", "Judges the estimate."),
  };
  return table;
}

class Verification final : public Step {
 public:
  explicit Verification(Params params) : params_(std::move(params)) {}

  Estimate advance(Estimate estimate, Rng&) const override {
    estimate.rejection = params_.verifier->objection(estimate);
    return estimate;
  }

 private:
  Params params_;
};

}  // namespace

StageEntry verification() {
  return stage_entry<Verification>("verification",
                                   "Rejects the estimate if a verifier objects to it.",
                                   "a step of a test", table());
}

}  // namespace croon::stages::step

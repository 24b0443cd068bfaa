#include "framework/stage/preprocessor.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"

namespace croon::stages::step {
namespace {

struct Params {
  std::vector<params::Slot<Preprocessor>> reference;
  std::vector<params::Slot<Preprocessor>> sensor;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::slots("reference", &Params::reference,
                    "Filters for the reference's cloud, in this order."),
      params::slots("sensor", &Params::sensor, "Filters for each sensor's cloud, in this order."),
  };
  return table;
}

/// The cloud after `preprocessors`, computed once for all initial guesses.
std::shared_ptr<const Cloud> preprocessed(
    std::shared_ptr<const Cloud> cloud,
    const std::vector<params::Slot<Preprocessor>>& preprocessors) {
  for (const params::Slot<Preprocessor>& preprocessor : preprocessors) {
    const std::string what = "preprocessor/" + preprocessor.name();
    cloud = cloud->once<Cloud>(what, preprocessor.resolved(), [&] {
      return cloud->derived(preprocessor->apply(cloud->with_channels()), what);
    });
  }
  return cloud;
}

class Preprocessing final : public Step {
 public:
  explicit Preprocessing(Params params) : params_(std::move(params)) {}

  static params::DataFlow data_flow(const Params& params) {
    params::DataFlow flow;
    for (const auto& slot : params.reference) {
      flow.target_channels.insert(slot.flow().target_channels.begin(),
                                  slot.flow().target_channels.end());
    }
    for (const auto& slot : params.sensor) {
      flow.source_channels.insert(slot.flow().source_channels.begin(),
                                  slot.flow().source_channels.end());
    }
    return flow;
  }

  Estimate advance(Estimate estimate, Rng&) const override {
    estimate.take_clouds(preprocessed(estimate.target, params_.reference),
                         preprocessed(estimate.source, params_.sensor));
    estimate.diagnostics = {
        {"target_points", static_cast<double>(estimate.target->points().size())},
        {"source_points", static_cast<double>(estimate.source->points().size())}};
    return estimate;
  }

 private:
  Params params_;
};

}  // namespace

StageEntry preprocessing() {
  return stage_entry<Preprocessing>("preprocessing",
                                    "Crops or thins the clouds for the steps that follow.",
                                    "CROON's public code (lidar2lidar, commit c0e1e2b)", table());
}

}  // namespace croon::stages::step

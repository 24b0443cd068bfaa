#include <algorithm>
#include <memory>
#include <optional>

#include "framework/spatial/scan_times.hpp"
#include "framework/stage/motion.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"
#include "framework/stage/times.hpp"

namespace croon::stages::step {
namespace {

struct Params {
  bool ignore_times = false;
  bool at_rest = false;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::boolean("ignore_times", &Params::ignore_times,
                      "Removes all times, as if the clouds had none."),
      params::boolean("at_rest", &Params::at_rest,
                      "The rig is known to stand: removes all times, and no step estimates its "
                      "motion or looks for it."),
  };
  return table;
}

class TimeCheckStep final : public Step {
 public:
  explicit TimeCheckStep(const Params& params) : params_(params) {}

  static params::DataFlow data_flow(const Params&) {
    params::DataFlow flow = gives(kTimesInDoubt, kMotion, kMotionCovariance);
    flow.add(params::may_read_channels({kTime}));
    return flow;
  }

  Estimate advance(Estimate estimate, Rng&) const override {
    const std::optional<TimesInDoubt> doubt = doubt_about(*estimate.target, *estimate.source);
    if (params_.at_rest) {
      estimate.extras.put(kMotion, Twist());
      estimate.extras.put(kMotionCovariance, Matrix6d(Matrix6d::Zero()));
    }
    if (doubt) {
      estimate.take_clouds(without_times(estimate.target), without_times(estimate.source));
      estimate.extras.put(kTimesInDoubt, *doubt);
    }
    estimate.diagnostics = {{"has_usable_times", doubt ? 0.0 : 1.0}};
    return estimate;
  }

 private:
  std::optional<TimesInDoubt> doubt_about(const Cloud& target, const Cloud& source) const {
    if (params_.ignore_times || params_.at_rest) return TimesInDoubt{"times are ignored"};
    for (const Cloud* const cloud : {&target, &source}) {
      const TimeCheck& check = *cloud->once<TimeCheck>("time_check", [&] {
        return std::make_shared<const TimeCheck>(check_times(cloud->with_channels()));
      });
      if (!check.is_usable) {
        return TimesInDoubt{(cloud == &target ? "of the reference, " : "") + check.reason};
      }
    }
    const std::string reason = why_not_one_clock(
        {"the reference", "the sensor"}, {&target.with_channels(), &source.with_channels()});
    if (reason.empty()) return std::nullopt;
    return TimesInDoubt{reason, true};
  }

  static std::shared_ptr<const Cloud> without_times(const std::shared_ptr<const Cloud>& cloud) {
    if (find_channel(cloud->with_channels(), kTime) == nullptr) return cloud;
    return cloud->once<Cloud>("without_times", [&] {
      PointCloud untimed = cloud->with_channels();
      const auto is_time = [](const Channel& channel) { return channel.name == kTime; };
      untimed.channels.erase(
          std::remove_if(untimed.channels.begin(), untimed.channels.end(), is_time),
          untimed.channels.end());
      return cloud->derived(std::move(untimed), "without_times");
    });
  }

  Params params_;
};

}  // namespace

StageEntry time_check() {
  return stage_entry<TimeCheckStep>(
      "time_check",
      "Removes the times of both clouds if they are missing in one of them, cannot be those of a "
      "scan, or are not of one clock. Later steps that can do without times then treat the rig as "
      "at rest.",
      "croon", table());
}

}  // namespace croon::stages::step

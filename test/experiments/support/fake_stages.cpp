#include "test/experiments/support/fake_stages.hpp"

#include <limits>
#include <new>

#include "framework/base/error.hpp"
#include "framework/params/choice.hpp"
#include "framework/stage/dataset.hpp"
#include "framework/stage/rig_step.hpp"
#include "framework/stage/yaw_search.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::test {
namespace {

constexpr Extra<double> kToken{"token", "a distance in metres"};

struct FakeDatasetParams {
  int scenes = 2;
  int sensors = 2;
  bool truth = true;
  int points = 50;
  int unreadable = -1;
  int unreadable_scene = -1;
  bool kinds = false;
  bool one_rig = false;
  std::vector<std::string> channels = {};
};

class FakeDataset final : public Dataset {
 public:
  explicit FakeDataset(FakeDatasetParams params) : params_(params) {}

  std::vector<Scene> scenes(const std::filesystem::path&) const override {
    std::vector<Scene> scenes;
    for (int i = 0; i < params_.scenes; ++i) {
      // Not in the order of words: "scene10" would come before "scene2".
      Scene scene{"scene" + std::to_string(params_.scenes - i), {}, scan("top", i, -2), {}};
      if (params_.kinds) scene.kind = i % 2 == 0 ? "urban" : "narrow";
      for (int k = 0; k < params_.sensors; ++k) {
        scene.sensors.push_back(scan("s" + std::to_string(params_.sensors - 1 - k), i, k));
      }
      scenes.push_back(scene);
    }
    return scenes;
  }

 private:
  SensorScan scan(const std::string& sensor, int scene, int index) const {
    const std::uint64_t seed = static_cast<std::uint64_t>(100 * scene + index + 2);
    Rng rng = test_rng(seed);
    SensorScan scan;
    scan.sensor = sensor;
    if (params_.one_rig) rng = test_rng(static_cast<std::uint64_t>(index + 2));
    scan.nominal = random_pose(rng, 2.0);
    if (params_.truth) scan.truth = random_pose(rng, 2.0);
    // The reference has all that a sensor may lack.
    scan.channels = index == -2 ? std::vector<std::string>{"ring", "time"} : params_.channels;
    const bool is_readable = index != params_.unreadable ||
                             (params_.unreadable_scene >= 0 && scene != params_.unreadable_scene);
    scan.load = [seed, is_readable, count = params_.points] {
      if (!is_readable) throw InputError("/data/fake.pcd", "byte 7", "expected points");
      Rng points = test_rng(seed);
      return LoadedCloud{random_cloud(points, count, 10.0), 0};
    };
    return scan;
  }

  FakeDatasetParams params_;
};

struct CoarseParams {
  double step_deg = 5.0;
};

struct FineParams {
  int levels = 3;
};

struct BetweenParams {
  double low_deg = 0.0;
  double high_deg = 10.0;
};

/// A yaw search that looks nowhere; only its parameters matter.
template <class Params>
class FakeSearch final : public YawSearch {
 public:
  explicit FakeSearch(const Params&) {}
  YawMinimum minimise(const YawCost&) const override { return {}; }
};

struct DriftParams {
  double size_m = 0.01;
  params::Slot<YawSearch> search;
};

class Drift final : public Step {
 public:
  explicit Drift(DriftParams params) : params_(std::move(params)) {}

  Estimate advance(Estimate estimate, Rng& rng) const override {
    Rng once = estimate.source->rng("drift");
    const double shared = *estimate.source->once<double>("drift", [&] {
      return std::make_shared<const double>(once.uniform() / estimate.source->points().size());
    });
    for (int i = 0; i < 3; ++i) {
      estimate.T_target_source.translation(i) += params_.size_m * (rng.normal() + shared);
    }
    estimate.diagnostics = {{"shared", shared}, {"draw", rng.uniform()}};
    return estimate;
  }

 private:
  DriftParams params_;
};

struct GiveParams {
  double value = 1.0;
};

/// Gives the extra `token`.
class Give final : public Step {
 public:
  explicit Give(GiveParams params) : params_(params) {}

  static params::DataFlow data_flow(const GiveParams&) { return gives(kToken); }

  Estimate advance(Estimate estimate, Rng&) const override {
    estimate.extras.put(kToken, params_.value);
    return estimate;
  }

 private:
  GiveParams params_;
};

struct TakeParams {};

/// Moves the pose by the extra `token` along x.
class Take final : public Step {
 public:
  explicit Take(TakeParams) {}

  static params::DataFlow data_flow(const TakeParams&) { return takes(kToken); }

  Estimate advance(Estimate estimate, Rng&) const override {
    estimate.T_target_source.translation.x() += estimate.extras.get(kToken);
    return estimate;
  }
};

/// Gives an extra of the same name and another type.
class GiveOther final : public Step {
 public:
  explicit GiveOther(TakeParams) {}

  static params::DataFlow data_flow(const TakeParams&) {
    return gives(Extra<int>{"token", "a number"});
  }

  Estimate advance(Estimate estimate, Rng&) const override { return estimate; }
};

/// Needs the channels time of both clouds, and ring of the sensor's.
class Need final : public Step {
 public:
  explicit Need(TakeParams) {}

  static params::DataFlow data_flow(const TakeParams&) {
    params::DataFlow flow = params::needs_channels({kTime});
    flow.source_channels.insert(kRing);
    return flow;
  }

  Estimate advance(Estimate estimate, Rng&) const override { return estimate; }
};

/// Gives all estimates of the rig the mean x of them.
class Gather final : public RigStep {
 public:
  explicit Gather(TakeParams) {}

  void adjust(std::vector<RigEstimate>& rig, Rng& rng) const override {
    double sum = 0.0;
    for (const RigEstimate& one : rig) sum += one.estimate.T_target_source.translation.x();
    const double draw = rng.uniform();
    for (RigEstimate& one : rig) {
      one.estimate.T_target_source.translation.x() = sum / static_cast<double>(rig.size());
      one.estimate.diagnostics = {{"estimates", static_cast<double>(rig.size())}, {"draw", draw}};
    }
  }
};

enum class How { pass, reject, defeat, memory, bug, nan, far, skewed, judge, misjudge };

struct BehaveParams {
  How how = How::pass;
};

class Behave final : public Step {
 public:
  explicit Behave(BehaveParams params) : params_(std::move(params)) {}

  Estimate advance(Estimate estimate, Rng&) const override {
    if (params_.how == How::reject) estimate.rejection = "too few points";
    if (params_.how == How::defeat) throw StageError("no ground");
    if (params_.how == How::memory) throw std::bad_alloc();
    if (params_.how == How::bug) throw std::logic_error("a bug");
    if (params_.how == How::nan) {
      estimate.T_target_source.translation.x() = std::numeric_limits<double>::quiet_NaN();
    }
    if (params_.how == How::skewed) estimate.T_target_source.rotation(0, 0) += 0.01;
    if (params_.how == How::judge || params_.how == How::misjudge) {
      const double sign = params_.how == How::judge ? 1.0 : -1.0;
      estimate.covariance = PoseCovariance{sign * Matrix6d::Identity(), {}};
    }
    if (params_.how == How::far) estimate.T_target_source.translation.x() = -1e18;
    return estimate;
  }

 private:
  BehaveParams params_;
};

}  // namespace

Catalogue fake_catalogue() {
  using namespace params;
  Catalogue catalogue;
  catalogue.add(stage_entry<FakeDataset, FakeDatasetParams>(
      "fake", "Random clouds.", "croon",
      {integer("scenes", &FakeDatasetParams::scenes, {1, 100}, "How many scenes."),
       integer("sensors", &FakeDatasetParams::sensors, {1, 200}, "How many sensors."),
       boolean("truth", &FakeDatasetParams::truth, "Whether there is truth."),
       integer("points", &FakeDatasetParams::points, {0, 1e6}, "Points per cloud."),
       integer("unreadable", &FakeDatasetParams::unreadable, {-2, 10}, "The unreadable cloud."),
       integer("unreadable_scene", &FakeDatasetParams::unreadable_scene, {-1, 100},
               "The only scene in which it is; -1 for all."),
       boolean("kinds", &FakeDatasetParams::kinds, "Whether scenes have kinds."),
       boolean("one_rig", &FakeDatasetParams::one_rig, "Whether poses are the same in all scenes."),
       texts("channels", &FakeDatasetParams::channels, "The channels of the sensors' clouds.")}));
  catalogue.add(stage_entry<FakeSearch<CoarseParams>, CoarseParams>(
      "coarse", "Looks nowhere.", "croon",
      {number("step_deg", &CoarseParams::step_deg, {0.1, 90}, "Its step.")}));
  catalogue.add(stage_entry<FakeSearch<FineParams>, FineParams>(
      "fine", "Looks nowhere.", "croon",
      {integer("levels", &FineParams::levels, {1, 9}, "Its levels.")}));
  catalogue.add(stage_entry<FakeSearch<BetweenParams>, BetweenParams>(
      "between", "Looks nowhere.", "croon",
      Table<BetweenParams>{number("low_deg", &BetweenParams::low_deg, {0, 90}, "Its begin."),
                           number("high_deg", &BetweenParams::high_deg, {0, 90}, "Its end.")}
          .require([](const BetweenParams& p) { return p.low_deg <= p.high_deg; },
                   "low_deg must not be above high_deg")
          .rule({"low_deg", {}, false, {"high_deg"}})));
  catalogue.add(stage_entry<Drift, DriftParams>(
      "drift", "Moves the pose.", "croon",
      {number("size_m", &DriftParams::size_m, {0, 10}, "How far.").formerly("extent_m"),
       slot("search", &DriftParams::search, R"({"type": "coarse"})", "A stage in a stage.")}));
  catalogue.add(stage_entry<Give, GiveParams>(
      "give", "Gives an extra.", "croon",
      {number("value", &GiveParams::value, {-10, 10}, "Its value.")}));
  catalogue.add(stage_entry<Take, TakeParams>("take", "Takes an extra.", "croon", {}));
  catalogue.add(stage_entry<Gather, TakeParams>("gather", "Sees the rig.", "croon", {}));
  catalogue.add(stage_entry<GiveOther, TakeParams>("give_other", "Gives another.", "croon", {}));
  catalogue.add(stage_entry<Need, TakeParams>("need", "Needs channels.", "croon", {}));
  catalogue.add(stage_entry<Behave, BehaveParams>("behave", "Behaves as it is told to.", "croon",
                                                  {choice("how", &BehaveParams::how,
                                                          {{"pass", How::pass},
                                                           {"reject", How::reject},
                                                           {"defeat", How::defeat},
                                                           {"memory", How::memory},
                                                           {"bug", How::bug},
                                                           {"nan", How::nan},
                                                           {"far", How::far},
                                                           {"skewed", How::skewed},
                                                           {"judge", How::judge},
                                                           {"misjudge", How::misjudge}},
                                                          "What it does.")}));
  return catalogue;
}

}  // namespace croon::test

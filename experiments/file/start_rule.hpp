#pragma once

#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/params/node.hpp"
#include "framework/stage/catalogue.hpp"
#include "registry/experiment_keys.hpp"

namespace croon::experiments {

/// The pose that starts are drawn around.
enum class StartCentre { truth, nominal, initial };

/// What a ramp of starts makes larger from level to level.
enum class SweepOf { rotation, translation };

/// A ramp of the size of a start's perturbation: level k of n has the size
/// `first + (last - first) k / (n - 1)`.
struct Sweep {
  SweepOf of = SweepOf::rotation;
  double first = 0.0;  ///< deg of rotation, m of translation.
  double last = 0.0;
  int levels = 2;
};

/// A start `T_reference_sensor` as files have it; the rotation is of unit length.
struct Start {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  operator RigidTransform() const { return {rotation.toRotationMatrix(), translation}; }
};

/// The starts of a file by scene and sensor, in the order of their trials.
struct StartTable {
  std::map<std::pair<std::string, std::string>, std::vector<Start>> starts;
  int trials = 0;  ///< Of each scene and sensor.
  std::string sha256;
};

/// Where starts come from: they are drawn, (R, t) moved to (R_d R, t + d), see DESIGN.md section 4,
/// or read from a file.
struct StartRule {
  StartCentre around = StartCentre::truth;
  /// Half range of each of R_d = Rz Ry Rx; 180 is uniform on SO(3).
  double rotation_deg = StartKeys{}.rotation_deg;
  double translation_m = StartKeys{}.translation_m;  ///< Half range of each of d, reference axes.
  /// Per variant, scene and sensor, over all levels of a sweep; 0 before a file is read: all of it.
  int trials = StartKeys{}.trials;
  std::optional<Sweep> sweep = {};  ///< Takes the place of the range of what it sweeps.
  std::string file = {};            ///< Of starts that are not drawn; else empty.
  std::shared_ptr<const StartTable> table = {};  ///< What is in the file, once it is read.
};

/// The rule that the optional key "starts" of the experiment `root` describes; notes faults in it.
/// A file of starts is named, not read.
StartRule read_start_rule(const params::Node& root, const Catalogue& catalogue);

/// Takes `trials` for those of the experiment file: per level of a sweep; 0 keeps what there is.
/// Throws InputError where they are more than kMaxTrials.
void set_trials(StartRule& rule, int trials);

/// JSON text of the rule without the number of trials.
std::string starts_json(const StartRule& rule);

/// What of it decides a start: not what a file of starts is called.
std::string deciding_starts_json(const StartRule& rule);

/// The sweep of the rule that `starts_json` told of; nothing where it has none.
std::optional<Sweep> sweep_of_json(const nlohmann::json& starts);

/// The word for a centre of starts in JSON: "truth", "nominal" or "initial".
const char* centre_name(StartCentre centre);

/// The level of a trial: level l has the trials l, l + levels, l + 2 levels, ..., so that more
/// trials renumber none.
inline int level_of(const Sweep& sweep, int trial) { return trial % sweep.levels; }

/// The size of the perturbation at `level`, deg or m.
inline double level_size(const Sweep& sweep, int level) {
  return sweep.first + (sweep.last - sweep.first) * level / (sweep.levels - 1);
}

}  // namespace croon::experiments

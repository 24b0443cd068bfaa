#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/params/choice.hpp"

namespace croon::experiments {

/// The maximum number of trials per variant, scene and sensor.
inline constexpr int kMaxTrials = 1000000;

/// The pose around which initial guesses are drawn.
enum class StartCentre { truth, nominal, initial };

/// The words for StartCentre in JSON.
inline const params::Words<StartCentre> kStartCentres = {{"truth", StartCentre::truth},
                                                         {"nominal", StartCentre::nominal},
                                                         {"initial", StartCentre::initial}};

/// The quantity that a sweep increases from level to level.
enum class SweepOf { rotation, translation };

/// A series of starts with increasing perturbation: level k of n has the size `first + (last -
/// first) k / (n - 1)`.
struct Sweep {
  SweepOf of = SweepOf::rotation;
  double first = 0.0;  ///< deg of rotation, m of translation.
  double last = 0.0;
  int levels = 11;
};

/// A start `T_reference_sensor` in the form used by files; the rotation has unit length.
struct Start {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  operator RigidTransform() const { return {rotation.toRotationMatrix(), translation}; }
};

/// The starts of a file by scene and sensor, in the order of their trials.
struct StartTable {
  std::map<std::pair<std::string, std::string>, std::vector<Start>> starts;
  int trials = 0;  ///< Per scene and sensor.
  std::string sha256;
};

/// The origin of starts. They are drawn: the pose (R, t) moved to (R_d R, t + d) with R_d = Rz Ry
/// Rx of three uniform draws and d of three more, in reference axes. Or a file lists them. Or there
/// are none: each trial starts at the identity.
struct StartRule {
  StartCentre around = StartCentre::truth;
  /// Half ranges of roll, pitch and yaw of R_d; all three 180 is uniform on SO(3).
  params::PerAxis rotation_deg = 45.0;
  params::PerAxis translation_m = 0.1;  ///< Half ranges of the elements of d.
  /// Per variant, scene and sensor, and per level of a sweep; 0: all starts in a file.
  int trials = 50;
  std::optional<Sweep> sweep = {};               ///< Replaces the range of the swept quantity.
  std::string file = {};                         ///< File of starts; empty if they are drawn.
  std::string sha256 = {};                       ///< Required digest of the file; empty for any.
  std::shared_ptr<const StartTable> table = {};  ///< Content of the file, once read.
  bool is_none = false;                          ///< No initial guess; there is then one trial.
};

/// The value of "starts" for trials without an initial guess.
inline constexpr const char* kNoStarts = "none";

/// The keys of "starts".
const params::Table<StartRule>& start_table();

/// Canonical JSON of the rule.
std::string starts_json(const StartRule& rule);

/// The number of trials per variant, scene and sensor, including all levels of a sweep.
int total_trials(const StartRule& rule);

/// Replaces the rule's number of trials (per level of a sweep); 0 keeps it. Throws InputError if
/// the total exceeds kMaxTrials.
void set_trials(StartRule& rule, int trials);

/// Canonical JSON of everything that determines a start: without the number of trials and the name
/// of the file.
std::string deciding_starts_json(const StartRule& rule);

/// The level of a trial: level l has the trials l, l + levels, l + 2 levels, ..., so that
/// additional trials do not change the numbers of others.
inline int level_of(const Sweep& sweep, int trial) { return trial % sweep.levels; }

/// The size of the perturbation at `level`, deg or m.
inline double level_size(const Sweep& sweep, int level) {
  return sweep.first + (sweep.last - sweep.first) * level / (sweep.levels - 1);
}

}  // namespace croon::experiments

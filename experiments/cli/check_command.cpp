#include <algorithm>
#include <memory>

#include "experiments/cli/command.hpp"
#include "experiments/cli/commands.hpp"
#include "experiments/cli/options.hpp"
#include "experiments/cli/requested_calibration.hpp"
#include "experiments/cli/watch.hpp"
#include "framework/base/text.hpp"
#include "framework/calibration/check_rig.hpp"

namespace croon::experiments {
namespace {

/// "RIGHT      ", coloured if `colours`.
std::string judgement_text(PoseJudgement judgement, bool colours) {
  constexpr std::size_t kColumns = 11;
  const std::string text = left_aligned(capitals(name_of(judgement)), kColumns);
  if (!colours) return text;
  const char* const colour = judgement == PoseJudgement::right   ? "\033[32m"
                             : judgement == PoseJudgement::wrong ? "\033[31m"
                                                                 : "\033[33m";
  return colour + text + "\033[0m";
}

/// The difference along each degree of freedom in standard deviations: "roll 0.3  pitch 1.2 ...".
std::string deviations_text(const CheckedSensor& checked) {
  std::string text;
  for (int i = 0; i < 6; ++i) {
    text += (text.empty() ? "" : "  ") + kDofNames.at(static_cast<std::size_t>(i)) + " " +
            fixed_number(checked.difference(i) / checked.deviations(i), 1);
  }
  return text;
}

std::string sensor_text(const CheckedSensor& checked, bool colours) {
  std::string text = judgement_text(checked.judgement, colours) + "  " + printable(checked.sensor) +
                     ": " + checked.finding + "\n";
  if (checked.optimum) {
    text += "  standard deviations from the optimum: " + fixed_number(checked.distance, 1) + ";  " +
            deviations_text(checked) + "\n";
  }
  for (const std::string& reason : checked.reasons) text += "  why: " + printable(reason) + "\n";
  return text;
}

/// Whether the calibration from scratch rejected a sensor that has a given pose.
bool needs_second_look(const CalibratedRig& rig) {
  return std::any_of(rig.sensors.begin(), rig.sensors.end(), [](const CalibratedSensor& sensor) {
    return !sensor.is_accepted && sensor.nominal.has_value();
  });
}

/// Checks the poses in the file `options.nominal` against the clouds of `options.inputs`, which are
/// read as by croon calibrate. Prints for each sensor whether its pose is right, wrong or
/// undecidable, and how far it is from the optimum, in total and per degree of freedom. Writes no
/// files; progress goes to `err`. Returns 3 unless all poses are right. Throws InputError if the
/// request is wrong.
int check_command(const CalibrateOptions& given, const Catalogue& catalogue, std::ostream& out,
                  std::ostream& err) {
  CalibrateOptions options = with_file(given);
  RecordedScenes recorded = scenes_of(options);
  const std::vector<std::string> about_poses = set_nominal(recorded.scenes, options.nominal);
  options.from_scratch = true;
  const CalibratedRig from_nothing =
      calibrate_with_progress(options, recorded.scenes, catalogue, err);
  print_notes(from_nothing.notes, err);
  std::optional<CalibratedRig> near_given;
  if (needs_second_look(from_nothing)) {
    options.from_scratch = false;
    near_given = calibrate_with_progress(options, recorded.scenes, catalogue, err);
  }
  const std::vector<CheckedSensor> sensors = check_rig(from_nothing, near_given);
  for (const CheckedSensor& sensor : sensors) out << sensor_text(sensor, options.colours);
  const auto list = [&](const char* title, const std::vector<std::string>& lines) {
    for (const std::string& line : lines) out << title << " " << printable(line) << "\n";
  };
  list("warning:", about_poses);
  list("warning:", from_nothing.warnings);
  list("not used:", recorded.unused);
  list("not used:", from_nothing.unused);
  const bool is_all_right = std::all_of(
      sensors.begin(), sensors.end(),
      [](const CheckedSensor& sensor) { return sensor.judgement == PoseJudgement::right; });
  return is_all_right ? 0 : 3;
}

class CheckCommand final : public Command {
 public:
  std::string sentence() const override {
    return "Check given extrinsics: right, wrong or undecidable.";
  }

  void add_options(CLI::App& command) override {
    add_path(command, "EXTRINSICS", options_.nominal,
             "The poses, in any format that --nominal accepts.")
        ->required();
    add_path(command, "INPUT", options_.inputs, "Clouds, as for croon calibrate.")->required();
    add_rig_options(command, options_);
    CLI::Option* const watch = command.add_flag(
        "--watch", watch_, "Audit scan by scan, also in folders that grow, and say what changes.");
    add_path(command, "--log", options_.log,
             "With --watch: new CSV file, a row per scan and sensor.")
        ->needs(watch);
    add_number(command, "--false-alarm-every", options_.false_alarm_every_h, 0.001, 1e6,
               "With --watch: mean time between false alarms at 10 Hz, hours; default 10.")
        ->needs(watch);
    add_number(command, "--until-idle", options_.until_idle_s, 0.0, 1e9,
               "With --watch: end if a growing folder has no new scan for this time, s.")
        ->needs(watch);
  }

  int run(const Console& console) override {
    options_.colours = console.colours;
    if (watch_) return watch_command(options_, console.out, console.err);
    return check_command(options_, console.catalogue, console.out, console.err);
  }

 private:
  WatchOptions options_;
  bool watch_ = false;
};

}  // namespace

std::unique_ptr<Command> make_check_command() { return std::make_unique<CheckCommand>(); }

}  // namespace croon::experiments

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <set>

#include "experiments/cli/command.hpp"
#include "experiments/cli/commands.hpp"
#include "experiments/cli/options.hpp"
#include "experiments/cli/requested_calibration.hpp"
#include "experiments/report/calibration_document.hpp"
#include "experiments/session/staged_folder.hpp"
#include "experiments/store/manifest.hpp"
#include "experiments/store/version.hpp"
#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/calibration/extrinsics.hpp"
#include "framework/calibration/loaded_scene.hpp"
#include "framework/calibration/reference_hint.hpp"
#include "framework/calibration/rig_extrinsics.hpp"
#include "framework/calibration/rig_pictures.hpp"
#include "framework/document/renderers.hpp"
#include "framework/io/digest.hpp"
#include "framework/io/text_scan.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRequestFile = "rig.json";
constexpr const char* kJsonFile = "extrinsics.json";
constexpr const char* kReportFile = "report.html";
constexpr const char* kBaseFrame = "base_link";

/// The pose "x,y,z,roll,pitch,yaw"; std::nullopt if `text` is not six numbers.
std::optional<RigidTransform> pose_in(const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string word(trimmed(std::string_view(text).substr(begin, end - begin)));
    const std::optional<double> number = number_from(word);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    numbers.push_back(*number);
    begin = end + 1;
  }
  if (numbers.size() != 6) return std::nullopt;
  const Eigen::Vector3d rpy_deg(numbers[3], numbers[4], numbers[5]);
  return RigidTransform{rotation_from_rpy(rpy_deg * rad_from_deg(1.0)),
                        {numbers[0], numbers[1], numbers[2]}};
}

/// The pose of the reference in the vehicle frame: `base` itself, or its entry in the file `base`.
RigidTransform base_pose(const std::string& base, const std::string& reference) {
  if (const std::optional<RigidTransform> pose = pose_in(base)) return *pose;
  if (base.find(',') != std::string::npos) {
    throw InputError("", "--base",
                     "expected a file or six numbers x,y,z,roll,pitch,yaw in metres and degrees, "
                     "found " +
                         in_quotes(base));
  }
  const Extrinsics poses = read_extrinsics(base);
  std::vector<std::string> known;
  for (const ExtrinsicPose& pose : poses.poses) {
    if (pose.sensor == reference) return pose.T_parent_sensor;
    known.push_back(pose.sensor);
  }
  throw InputError(base, "",
                   "expected the pose of the reference " + in_quotes(reference) + ", found none" +
                       name_hint(reference, known));
}

/// Throws InputError for a format that does not exist.
void check_formats(const std::vector<std::string>& formats) {
  std::vector<std::string> known = extrinsics_format_names();
  known.emplace_back("json");
  for (const std::string& format : formats) {
    if (std::find(known.begin(), known.end(), format) != known.end()) continue;
    throw InputError("", "--format",
                     "unknown format " + in_quotes(format) + name_hint(format, known));
  }
}

/// The scene to draw: the first with the maximum number of sensors.
Scene& drawn_scene(std::vector<Scene>& scenes) {
  return *std::max_element(scenes.begin(), scenes.end(), [](const Scene& a, const Scene& b) {
    return a.sensors.size() < b.sensors.size();
  });
}

/// Makes `scan` read its cloud at the first call only and keep it in memory.
void keep_cloud(SensorScan& scan) {
  struct Kept {
    std::once_flag once;
    LoadedCloud cloud;
  };
  scan.load = [load = scan.load, kept = std::make_shared<Kept>()] {
    std::call_once(kept->once, [&] { kept->cloud = load(); });
    return kept->cloud;
  };
}

void keep_clouds(Scene& scene) {
  keep_cloud(scene.reference);
  for (SensorScan& scan : scene.sensors) keep_cloud(scan);
}

/// The poses in the vehicle frame, with the reference as the first sensor.
Extrinsics in_base(const Extrinsics& extrinsics, const RigidTransform& T_base_reference) {
  Extrinsics in_base = in_frame(extrinsics, kBaseFrame, T_base_reference);
  in_base.poses.insert(in_base.poses.begin(), {extrinsics.parent, T_base_reference});
  return in_base;
}

/// Writes `extrinsics` to `root / folder` in each format; returns the paths relative to `root`.
std::vector<std::string> write_formats(const fs::path& root, const fs::path& folder,
                                       const Extrinsics& extrinsics,
                                       const std::vector<std::string>& formats,
                                       bool with_rejected) {
  std::vector<std::string> paths;
  for (const std::string& format : formats) {
    if (format == "json") continue;
    for (const ExtrinsicsFile& file : write_extrinsics(extrinsics, format, with_rejected)) {
      const fs::path path = folder / file.name;
      if (path.has_parent_path()) make_folder_below(root, path.parent_path());
      write_whole_file(root / path, file.text);
      paths.push_back(path.string());
    }
  }
  return paths;
}

/// The pictures of a scene, and the paths of the files of its clouds.
struct Drawn {
  std::vector<RigPicture> pictures;
  std::vector<std::string> cloud_files;
};

/// Draws `scene`, and writes its clouds below `root` if `with_clouds`. Unreadable clouds are not
/// drawn.
Drawn draw(const fs::path& root, const CalibratedRig& rig, const Scene& scene, bool with_clouds) {
  const ReadScan reference = read_scan(scene.reference);
  if (!reference.is_usable()) return {};
  std::vector<ReadScan> scans;
  std::vector<PosedCloud> posed;
  for (const SensorScan& scan : scene.sensors) scans.push_back(read_scan(scan));
  for (const CalibratedSensor& sensor : rig.sensors) {
    const std::size_t i = index_of(scene, sensor.sensor);
    if (i == scans.size() || !scans[i].is_usable()) continue;
    posed.push_back({sensor.sensor, &scans[i].cloud.points, sensor.nominal,
                     sensor.T_reference_sensor, sensor.is_accepted, picture_note(sensor)});
  }
  const Points& points = reference.cloud.points;
  Drawn drawn{draw_rig_pictures(rig.reference, points, posed), {}};
  if (with_clouds) drawn.cloud_files = write_rig_clouds(root, rig.reference, points, posed);
  return drawn;
}

/// Where the result comes from: the program, the request and its inputs.
Facts provenance_of(const CalibrateOptions& options, const std::vector<Scene>& scenes) {
  constexpr std::uintmax_t kMaxDigestedBytes = 1U << 28U;
  Facts facts{{{"croon", std::string(croon_version()) + ", commit " + croon_commit()},
               {"request", rig_request_json(options, options.out)},
               {"date", utc_time()}}};
  std::set<std::string> files;
  for (const Scene& scene : scenes) {
    for (std::size_t i = 0; i <= scene.sensors.size(); ++i) files.insert(scan_at(scene, i).file);
  }
  files.erase("");
  for (const std::string& file : files) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    if (error) continue;
    facts.facts.emplace_back(file, size > kMaxDigestedBytes ? std::to_string(size) + " bytes"
                                                            : "sha256 " + sha256_of_file(file));
  }
  return facts;
}

/// The formats without repeats, csv first.
std::vector<std::string> all_formats(const std::vector<std::string>& formats) {
  std::vector<std::string> all = {"csv"};
  for (const std::string& format : formats) {
    if (std::find(all.begin(), all.end(), format) == all.end()) all.push_back(format);
  }
  return all;
}

/// The files of a folder; paths are relative to it.
struct FolderFiles {
  std::vector<std::string> written;
  std::vector<std::string> left;  ///< Left by an earlier calibration.
  std::string lead;               ///< The main result according to the report; empty without one.
};

/// Writes all files. `drawn` is one of `scenes`.
FolderFiles write_files(const CalibrateOptions& options, const CalibratedRig& rig,
                        const std::vector<Scene>& scenes, const Scene& drawn,
                        const std::optional<RigidTransform>& T_base_reference,
                        StagedFolder& folder) {
  const fs::path& root = folder.make_staging();
  const std::vector<std::string> formats = all_formats(options.formats);
  const Extrinsics extrinsics = extrinsics_of(rig);
  std::string lead;
  std::vector<std::string> paths =
      write_formats(root, "", extrinsics, formats, options.with_rejected);
  const auto add = [&](const std::vector<std::string>& more) {
    paths.insert(paths.end(), more.begin(), more.end());
  };
  if (T_base_reference) {
    add(write_formats(root, kBaseFrame, in_base(extrinsics, *T_base_reference), formats,
                      options.with_rejected));
  }
  if (!options.no_pictures) {
    const Drawn result = draw(root, rig, drawn, options.clouds);
    for (const RigPicture& picture : result.pictures) {
      write_whole_file(root / picture.file, picture.png);
      paths.push_back(picture.file);
    }
    add(result.cloud_files);
    if (can_write_html()) {
      const Facts provenance = provenance_of(options, scenes);
      const Document report = calibration_report(rig, result.pictures, provenance);
      lead = report.lead;
      write_whole_file(root / kReportFile, html_document(report));
      paths.emplace_back(kReportFile);
    }
  }
  write_whole_file(root / kJsonFile, rig_extrinsics_json(rig));
  write_whole_file(root / kRequestFile, rig_request_json(options, options.out));
  add({kJsonFile, kRequestFile});
  return {paths, folder.publish(), lead};
}

/// Calibrates the rig, prints the result and writes it to `options.out`; progress goes to `err`.
/// Returns 3 if a sensor is rejected. Throws InputError, before anything is written, if the request
/// is wrong.
int calibrate_command(const CalibrateOptions& given, const Catalogue& catalogue, std::ostream& out,
                      std::ostream& err) {
  const CalibrateOptions options = with_file(given);
  check_formats(options.formats);
  if (options.nominal.empty() && (options.nominal_std_deg || options.nominal_std_m)) {
    throw InputError("", "--nominal-std-deg, --nominal-std-m",
                     "expected nominal poses (--nominal)");
  }
  RecordedScenes recorded = scenes_of(options);
  const std::vector<std::string> about_nominal = set_nominal(recorded.scenes, options.nominal);
  std::optional<RigidTransform> T_base_reference;
  if (!options.base.empty()) {
    T_base_reference = base_pose(options.base, recorded.scenes.front().reference.sensor);
  }
  StagedFolder folder(options.out, kRequestFile);
  Scene& drawn = drawn_scene(recorded.scenes);
  if (!options.no_pictures) keep_clouds(drawn);
  CalibratedRig rig = calibrate_with_progress(options, recorded.scenes, catalogue, err);
  print_notes(rig.notes, err);
  rig.unused.insert(rig.unused.begin(), recorded.unused.begin(), recorded.unused.end());
  rig.warnings.insert(rig.warnings.begin(), about_nominal.begin(), about_nominal.end());
  if (options.reference.empty()) {
    const std::string hint = reference_hint(rig);
    if (!hint.empty()) rig.warnings.push_back(hint);
  }
  const FolderFiles files =
      write_files(options, rig, recorded.scenes, drawn, T_base_reference, folder);
  const auto list = [&](const std::string& title, const std::vector<std::string>& paths) {
    if (paths.empty()) return;
    out << title << ":";
    for (const std::string& path : paths) out << " " << printable(path);
    out << "\n";
  };
  out << calibration_text(rig, options.colours) << "\n";
  list("files in " + printable(options.out.string()), files.written);
  if (!files.lead.empty()) {
    out << "look at " << printable((options.out / kReportFile).string()) << ": "
        << printable(files.lead) << "\n";
  }
  list("left there by an earlier calibration", files.left);
  const bool is_any_rejected =
      std::any_of(rig.sensors.begin(), rig.sensors.end(),
                  [](const CalibratedSensor& sensor) { return !sensor.is_accepted; });
  return is_any_rejected ? 3 : 0;
}

class CalibrateCommand final : public Command {
 public:
  std::string sentence() const override {
    return "Calibrate a vehicle's LiDARs to each other, from recordings.";
  }

  void add_options(CLI::App& command) override {
    CalibrateOptions& o = options_;
    add_path(command, "INPUT", o.inputs,
             "A file or folder of clouds per sensor, PATH or NAME=PATH; a recording (.mcap, .db3) "
             "and its topics; or a rig.json.")
        ->required();
    add_path(
        command, "--nominal", o.nominal,
        "Poses to compare with; a sensor that is rejected is tried again near its nominal pose.");
    command.add_flag("--from-scratch", o.from_scratch,
                     "Use the nominal poses for comparison only.");
    add_number(command, "--nominal-std-deg", o.nominal_std_deg, 1e-3, 60.0,
               "Standard deviation of the nominal rotations; three are searched; default 10.");
    add_number(command, "--nominal-std-m", o.nominal_std_m, 1e-3, 10.0,
               "Standard deviation of the nominal positions; three are searched; default 0.33.");
    add_text(
        command, "--base", o.base,
        "The reference's pose in the vehicle frame, x,y,z,roll,pitch,yaw in m and degrees or a "
        "file of extrinsics; writes the results in base_link too.",
        "a pose or a path");
    add_path(command, "--out", o.out, "Folder to write to; default results/calibration.");
    add_text(command, "--format", o.formats,
             "Additional formats of extrinsics, comma-separated: " +
                 list_text(extrinsics_format_names()) + ".",
             "a format")
        ->delimiter(',');
    command.add_flag("--with-rejected", o.with_rejected,
                     "Write rejected poses too, marked as rejected.");
    command.add_flag("--clouds", o.clouds, "Write the clouds in the reference's frame.");
    command.add_flag("--no-pictures", o.no_pictures, "Draw no pictures and write no report.");
    add_rig_options(command, o);
  }

  int run(const Console& console) override {
    options_.colours = console.colours;
    return calibrate_command(options_, console.catalogue, console.out, console.err);
  }

 private:
  CalibrateOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_calibrate_command() { return std::make_unique<CalibrateCommand>(); }

}  // namespace croon::experiments

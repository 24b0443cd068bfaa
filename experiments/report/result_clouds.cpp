#include "experiments/report/result_clouds.hpp"

#include <algorithm>
#include <optional>

#include "experiments/run/starts.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/digest.hpp"
#include "framework/io/ply_file.hpp"
#include "framework/io/vdb_writer.hpp"
#include "framework/picture/cloud_view.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

using Pose = std::optional<RigidTransform>;

/// The scene of `group` that is shown under the group's name: clouds of different scenes were
/// recorded at different places.
const Scene& shown(const SceneGroup& group) { return group.scenes.front(); }

/// For each sensor of the shown scene the pose that all scenes agree on; std::nullopt if no two
/// trials agree, or for a sensor without a usable pose in this group, whose cloud may be
/// unreadable.
std::vector<Pose> agreed_poses(const Summary& summary, const Variant& variant,
                               const SceneGroup& group) {
  std::vector<Pose> poses;
  for (const SensorScan& scan : shown(group).sensors) {
    Pose& pose = poses.emplace_back();
    for (const SummaryRow* row : rows_of(summary, variant.name, scan.sensor)) {
      const auto is_it = [&](const SceneSummary& of) {
        return of.scene == group.name && of.consensus;
      };
      const RigidTransform* const agreed = agreed_consensus(*row);
      if (agreed != nullptr && std::any_of(row->scenes.begin(), row->scenes.end(), is_it)) {
        pose = *agreed;
      }
    }
  }
  return poses;
}

/// The picture of the shown scene with its sensors at `poses`.
Image drawn(const Experiment& experiment, const SceneGroup& group, const std::vector<Pose>& poses) {
  const Scene& scene = shown(group);
  std::vector<ColouredCloud> before = {{scene.reference.sensor, scene.reference.load().points, {}}};
  std::vector<ColouredCloud> after = before;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const SensorScan& scan = scene.sensors[i];
    const Points points = scan.load().points;
    before.push_back(
        {scan.sensor, points, start_of(experiment, group.name, to_reference(scene, scan), 0)});
    after.push_back({scan.sensor, points, *poses[i]});
  }
  const CloudView view = {20.0, 20.0, 0.05};
  std::vector<std::string> sensors;
  for (const ColouredCloud& cloud : after) sensors.push_back(cloud.sensor);
  return with_legend({draw_view(before, view), draw_view(after, view)},
                     {"before: initial guesses", "after: results"}, sensors, view.pixel_m);
}

/// The points of `scan`; empty if its file is damaged (the failed trials already report that).
/// Throws UnavailableFile.
Points points_of(const SensorScan& scan) {
  try {
    return scan.load().points;
  } catch (const UnavailableFile&) {
    throw;
  } catch (const InputError&) {
    return {};
  }
}

/// Replaces parts of the path `name` that are too long for a file name by their beginning and a
/// digest.
fs::path short_path(const fs::path& name) {
  constexpr std::size_t kMaxPartBytes = 200, kShownColumns = 40, kDigits = 16;
  fs::path path;
  for (const std::string part : name) {
    const bool is_short = part.size() <= kMaxPartBytes;
    path /= is_short
                ? part
                : cut_to_columns(part, kShownColumns) + sha256_of_text(part).substr(0, kDigits);
  }
  return path;
}

/// Throws InputError if a file that `write_clouds` would replace was not written by croon.
void refuse_foreign_clouds(const fs::path& stem) {
  std::error_code error;
  const fs::path ply = stem.string() + ".ply";
  for (const fs::path& path : {ply, fs::path(stem.string() + ".vdb")}) {
    if (!fs::exists(fs::symlink_status(path, error)) || is_fused_ply(ply)) continue;
    throw InputError(path.string(), "", "not written: the existing file is not from croon");
  }
}

void write_clouds(const std::vector<ColouredCloud>& clouds, const fs::path& stem) {
  constexpr double kLeafSize_m = 0.05;
  write_fused_ply(stem.string() + ".ply", clouds);
  Points fused;
  for (const ColouredCloud& cloud : clouds) {
    const Points moved_points = transformed(cloud.points, cloud.T_reference_sensor);
    fused.insert(fused.end(), moved_points.begin(), moved_points.end());
  }
  write_occupancy_vdb(stem.string() + ".vdb", fused, kLeafSize_m);
}

}  // namespace

std::string draw_before_after(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                              const Summary& summary, const fs::path& path) {
  for (const SceneGroup& group : groups) {
    const std::vector<Pose> poses = agreed_poses(summary, experiment.variants.front(), group);
    if (std::count(poses.begin(), poses.end(), std::nullopt) > 0) continue;
    std::optional<Image> image;
    try {
      image = drawn(experiment, group, poses);
    } catch (const UnavailableFile&) {
      throw;
    } catch (const InputError&) {
      continue;  // The poses of a group may come from other scenes; this one's clouds are damaged.
    }
    write_png(path, *image);
    return group.name;
  }
  return "";
}

FusedClouds write_fused_clouds(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                               const Summary& summary, const fs::path& folder) {
  FusedClouds fused;
  std::vector<std::string>& complaints = fused.complaints;
  for (const SceneGroup& group : groups) {
    const Scene& scene = shown(group);
    Points reference;
    std::vector<Points> points;
    try {
      reference = points_of(scene.reference);
      for (const SensorScan& scan : scene.sensors) points.push_back(points_of(scan));
    } catch (const UnavailableFile& error) {
      complaints.push_back(error.faults().front().line() + "; the clouds of scene " + group.name +
                           " are not written");
      continue;
    }
    for (const Variant& variant : experiment.variants) {
      const std::vector<Pose> poses = agreed_poses(summary, variant, group);
      std::vector<ColouredCloud> clouds = {{scene.reference.sensor, reference, {}}};
      for (std::size_t i = 0; i < poses.size(); ++i) {
        if (poses[i]) clouds.push_back({scene.sensors[i].sensor, points[i], *poses[i]});
      }
      if (clouds.size() == 1) continue;
      fused.is_any = true;
      const fs::path name = short_path(variant.name) / short_path(group.name);
      const fs::path stem = folder / name;
      make_folder_below(folder.parent_path(), folder.filename() / name.parent_path());
      try {
        refuse_foreign_clouds(stem);
        write_clouds(clouds, stem);
      } catch (const InputError& error) {
        complaints.emplace_back(error.what());
      } catch (const StageError& error) {
        // A pose may be farther away than the coordinates of leaves allow.
        complaints.push_back(stem.string() + ".vdb: not written: " + error.what());
      }
    }
  }
  return fused;
}

}  // namespace croon::experiments

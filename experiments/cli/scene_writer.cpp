#include "experiments/cli/scene_writer.hpp"

#include "experiments/run/starts.hpp"
#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/opencalib_files.hpp"
#include "framework/io/pcd_file.hpp"
#include "framework/picture/top_view.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCloudList = "lidar_cloud_path.txt";

/// The path of a cloud as its list has it: relative to the dataset.
std::string cloud_path(const Scene& scene, const SensorScan& scan) {
  return scene.name + "/" + scan.sensor + ".pcd";
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "", "cannot be made: " + error.message());
}

}  // namespace

void write_scene(const Experiment& experiment, const Scene& scene, const fs::path& dataset) {
  const fs::path folder = dataset / scene.name;
  make_folder(folder);
  write_pcd(dataset / cloud_path(scene, scene.reference), scene.reference.measure());
  std::vector<ListedCloud> clouds = {{0, cloud_path(scene, scene.reference), ""}};
  std::vector<ListedPose> starts = {{0, {}, ""}};
  for (const SensorScan& scan : scene.sensors) {
    const int device_id = static_cast<int>(clouds.size());
    write_pcd(dataset / cloud_path(scene, scan), scan.measure());
    clouds.push_back({device_id, cloud_path(scene, scan), ""});
    starts.push_back({device_id, start_of(experiment, scene.name, scan, 0), ""});
  }
  write_whole_file(folder / "initial_extrinsic.txt", pose_list_text(starts));
  write_whole_file(folder / kCloudList, cloud_list_text(clouds));
}

bool is_written(const Scene& scene, const fs::path& dataset) {
  return fs::exists(dataset / scene.name / kCloudList);
}

void draw_scene(const Scene& scene, const fs::path& dataset) {
  std::vector<ColouredCloud> clouds = {{scene.reference.sensor, scene.reference.load().points, {}}};
  for (const SensorScan& scan : scene.sensors) {
    clouds.push_back({scan.sensor, scan.load().points, scan.truth.value_or(RigidTransform{})});
  }
  std::vector<Image> images;
  if (scene.draw) images.push_back(scene.draw());
  images.push_back(top_view(clouds, {25.0, 15.0, 0.06}));
  constexpr int kGap_px = 8;
  write_png(dataset / (scene.name + ".png"), side_by_side(images, kGap_px));
}

}  // namespace croon::experiments

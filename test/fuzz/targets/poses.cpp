// The JSON files beside recordings: poses of a rig, and kinds of scenes. Poses that are written and
// read again are those of `pose_as_written`.
#include "framework/stage/rig_files.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  const std::filesystem::path path = fuzz::write_input("poses.json", data, size);
  fuzz::is_taken([&] { read_scene_kinds(path); });
  RigPoses poses;
  if (!fuzz::is_taken([&] { poses = read_rig_poses(path); })) return 0;
  const std::string text = rig_poses_json(poses);
  const RigPoses again = read_rig_poses(fuzz::write_input(
      "again.json", reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  fuzz::require(again.size() == poses.size(), "poses are lost");
  for (const auto& [sensor, pose] : poses) {
    const RigidTransform read = again.at(sensor), written = pose_as_written(pose);
    fuzz::require(read.rotation == written.rotation && read.translation == written.translation,
                  "a pose is read back as another");
  }
  return 0;
}

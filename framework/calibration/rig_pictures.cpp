#include "framework/calibration/rig_pictures.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <set>

#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"
#include "framework/base/threads.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/calibration/sensor_picture.hpp"
#include "framework/io/pcd_file.hpp"
#include "framework/io/ply_file.hpp"
#include "framework/picture/cloud_view.hpp"

namespace croon {
namespace {

namespace fs = std::filesystem;

/// Draws rig.png: the view from above with its title and legend.
Image draw_rig(const std::string& reference, const Points& level_points,
               const std::vector<PosedCloud>& sensors, const LevelFrame& level) {
  const CloudView view = {20.0, 15.0, 0.03};
  std::vector<ColouredCloud> clouds = {{reference, level_points, {}}};
  std::string rejected;
  for (const PosedCloud& sensor : sensors) {
    if (!sensor.is_accepted || !sensor.after) {
      rejected +=
          (rejected.empty() ? " – not drawn, because REJECTED: " : ", ") + printable(sensor.sensor);
      continue;
    }
    clouds.push_back({sensor.sensor, *sensor.points, level.T_level_reference * *sensor.after});
  }
  std::vector<std::string> names;
  for (const ColouredCloud& cloud : clouds) {
    names.push_back(cut_in_the_middle(printable(cloud.sensor), 24));
  }
  return with_legend({draw_view(clouds, view)},
                     {cut_to_columns("the rig from above" + rejected, 80)}, names, view.pixel_m);
}

/// A cloud and its file name without suffix.
struct NamedFile {
  std::string stem;
  PointCloud cloud;
};

/// All accepted clouds in one, with a channel for the index of the sensor; the reference is 0.
PointCloud fused(const std::vector<ColouredCloud>& clouds) {
  PointCloud whole;
  std::vector<std::uint8_t> sensors;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const Points points = transformed(clouds[i].points, clouds[i].T_reference_sensor);
    whole.points.insert(whole.points.end(), points.begin(), points.end());
    sensors.resize(whole.size(), static_cast<std::uint8_t>(i));
  }
  set_channel(whole, make_channel("sensor", sensors));
  return whole;
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// `name` restricted to characters that every file system supports.
std::string safe_name(const std::string& name) {
  constexpr std::size_t kMaxBytes = 100;
  std::string safe;
  for (const char c : name) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-';
    if (is_plain) safe += c;
    if (!is_plain && !safe.empty() && safe.back() != '_') safe += '_';
  }
  safe.erase(0, safe.find_first_not_of("._-"));
  safe = safe.substr(0, kMaxBytes);
  safe.erase(safe.find_last_not_of("._-") + 1);
  return safe.empty() ? "sensor" : safe;
}

/// The names of the files of the reference and the sensors, without suffix.
std::vector<std::string> names_of_files(const std::string& reference,
                                        const std::vector<PosedCloud>& sensors) {
  std::vector<std::string> all = {reference};
  for (const PosedCloud& sensor : sensors) all.push_back(sensor.sensor);
  return file_names(all, {"rig", "fused"});
}

}  // namespace

std::string stds_text(const PoseCovariance& covariance, int first, double scale, int decimals) {
  std::vector<std::string> stds;
  for (int i = first; i < first + 3; ++i) {
    stds.push_back(fixed_number(scale * std::sqrt(covariance.matrix(i, i)), decimals));
  }
  return list_text(stds);
}

std::string picture_note(const CalibratedSensor& sensor) {
  if (!sensor.is_accepted) return sensor.reasons.empty() ? "" : sensor.reasons.front();
  if (!sensor.covariance) return "";
  return "std: rpy " + stds_text(*sensor.covariance, 0, deg_from_rad(1.0), 3) + "°; xyz " +
         stds_text(*sensor.covariance, 3, 1e3, 1) + " mm";
}

std::vector<std::string> file_names(const std::vector<std::string>& names,
                                    const std::vector<std::string>& taken) {
  std::set<std::string> used;
  for (const std::string& name : taken) used.insert(lower_case(name));
  std::vector<std::string> unique;
  for (const std::string& name : names) {
    const std::string safe = safe_name(name);
    unique.push_back(safe);
    for (int i = 2; !used.insert(lower_case(unique.back())).second; ++i) {
      unique.back() = safe + "_" + std::to_string(i);
    }
  }
  return unique;
}

std::vector<RigPicture> draw_rig_pictures(const std::string& reference, const Points& points,
                                          const std::vector<PosedCloud>& sensors) {
  const std::vector<std::string> names = names_of_files(reference, sensors);
  const LevelFrame level = level_frame(points);
  const Points level_points = transformed(points, level.T_level_reference);
  std::vector<RigPicture> pictures(sensors.size() + 1);
  for_each_in_parallel(sensors.size() + 1, [&](std::size_t i) {
    if (i == sensors.size()) {
      pictures[i] = {"rig.png", "", png_bytes(draw_rig(reference, level_points, sensors, level))};
      return;
    }
    const PosedCloud& sensor = sensors[i];
    if (!sensor.before && !sensor.after) return;
    const SensorPicture picture = {reference,     sensor.sensor,      sensor.note,
                                   &level_points, sensor.points,      sensor.before,
                                   sensor.after,  sensor.is_accepted, level};
    pictures[i] = {names[i + 1] + ".png", sensor.sensor, png_bytes(draw_sensor(picture))};
  });
  const auto is_missing = [](const RigPicture& picture) { return picture.file.empty(); };
  pictures.erase(std::remove_if(pictures.begin(), pictures.end(), is_missing), pictures.end());
  return pictures;
}

std::vector<std::string> write_rig_clouds(const fs::path& folder, const std::string& reference,
                                          const Points& points,
                                          const std::vector<PosedCloud>& sensors) {
  const std::vector<std::string> names = names_of_files(reference, sensors);
  std::vector<ColouredCloud> accepted = {{reference, points, {}}};
  std::vector<NamedFile> files = {{names.front(), points}};
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const PosedCloud& sensor = sensors[i];
    if (!sensor.after) continue;
    files.push_back({names[i + 1] + (sensor.is_accepted ? "" : "_rejected"),
                     transformed(*sensor.points, *sensor.after)});
    if (sensor.is_accepted) accepted.push_back({sensor.sensor, *sensor.points, *sensor.after});
  }
  make_folder_below(folder, "clouds");
  const fs::path clouds = folder / "clouds";
  for_each_in_parallel(files.size() + 2, [&](std::size_t i) {
    if (i == files.size()) return write_fused_ply(clouds / "fused.ply", accepted);
    if (i == files.size() + 1) return write_pcd(clouds / "fused.pcd", fused(accepted));
    write_ply(clouds / (files[i].stem + ".ply"), files[i].cloud);
    write_pcd(clouds / (files[i].stem + ".pcd"), files[i].cloud);
  });
  std::vector<std::string> written;
  files.push_back({"fused", {}});
  for (const NamedFile& file : files) {
    for (const char* suffix : {".ply", ".pcd"}) written.push_back("clouds/" + file.stem + suffix);
  }
  return written;
}

}  // namespace croon

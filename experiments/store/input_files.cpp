#include "experiments/store/input_files.hpp"

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/base/threads.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/digest.hpp"
#include "framework/io/point_cloud_file.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

/// `file` relative to the data root if it is below it; otherwise unchanged.
std::string relative_path(const std::string& file, const fs::path& data_root) {
  std::error_code error;
  const fs::path root = fs::canonical(data_root, error);
  // Compares only the names: a link in the data root may point outside it.
  const fs::path relative = fs::path(file).lexically_relative(root);
  const bool is_below = !error && !relative.empty() && *relative.begin() != "..";
  return is_below ? relative.generic_string() : file;
}

/// The scans that are read from files, each file once.
std::vector<const SensorScan*> scans_with_files(const std::vector<SceneGroup>& groups) {
  std::vector<const SensorScan*> scans;
  std::set<std::string> files = {""};
  const auto add = [&](const SensorScan& scan) {
    if (files.insert(scan.file).second) scans.push_back(&scan);
  };
  for (const SceneGroup& group : groups) {
    for (const Scene& scene : group.scenes) {
      add(scene.reference);
      for (const SensorScan& scan : scene.sensors) add(scan);
    }
  }
  return scans;
}

/// The maximum number of bytes of clouds kept from recording to running: a few dozen scans.
constexpr std::size_t kMaxKeptBytes = std::size_t{64} << 20;

std::size_t bytes_of(const PointCloud& cloud) {
  std::size_t bytes = cloud.points.size() * sizeof(Eigen::Vector3f);
  for (const Channel& channel : cloud.channels) bytes += channel.bytes.size();
  return bytes;
}

/// Clouds read for recording, kept until they are first needed. Thread-safe.
class KeptClouds {
 public:
  /// Keeps the cloud of `file` if there is space.
  void keep(const std::string& file, LoadedCloud cloud) {
    const std::size_t bytes = bytes_of(cloud);
    const std::lock_guard<std::mutex> lock(mutex_);
    if (bytes > kMaxKeptBytes - bytes_) return;
    bytes_ += bytes;
    clouds_.emplace(file, std::move(cloud));
  }
  /// Returns the cloud of `file` and forgets it; std::nullopt if it is not kept.
  std::optional<LoadedCloud> take(const std::string& file) {
    const std::lock_guard<std::mutex> lock(mutex_);
    auto node = clouds_.extract(file);
    if (node.empty()) return std::nullopt;
    return std::move(node.mapped());
  }

 private:
  std::mutex mutex_;
  std::size_t bytes_ = 0;
  std::map<std::string, LoadedCloud> clouds_;
};

/// The file of `scan`. Its counts, its digest and the cloud added to `kept` come from the same
/// bytes.
InputFile input_file(const SensorScan& scan, const fs::path& data_root, KeptClouds& kept) {
  InputFile input{relative_path(scan.file, data_root), "", {}, {}, scan.file};
  try {
    LoadedCloud cloud = scan.load();
    input.points = cloud.points.size();
    input.dropped_non_finite = cloud.dropped_non_finite;
    input.sha256 = cloud.sha256;
    if (!input.sha256.empty()) kept.keep(scan.file, std::move(cloud));
  } catch (const UnavailableFile&) {
    throw;
  } catch (const DamagedCloud& damaged) {
    // The trials fail and report the reason.
    input.sha256 = damaged.sha256();
  } catch (const InputError&) {
  }
  if (input.sha256.empty()) input.sha256 = sha256_of_file(scan.file);
  return input;
}

/// SensorScan::load for a scan of the file `input`: returns the `kept` cloud, if any, and throws
/// UnavailableFile if the bytes that it reads differ from those of `input`. Faults end with the
/// path in the manifest, because the reason of a failed trial must not contain a path that depends
/// on the data root.
std::function<LoadedCloud()> held_to(const InputFile& input, const SensorScan& scan,
                                     const std::shared_ptr<KeptClouds>& kept) {
  return [path = input.path, sha256 = input.sha256, file = scan.file, load = scan.load, kept] {
    if (kept) {
      if (std::optional<LoadedCloud> cloud = kept->take(file)) return std::move(*cloud);
    }
    const auto check = [&](const std::string& found) {
      if (found.empty() || found == sha256) return;
      throw UnavailableFile(path, "", "has changed since the start of the run");
    };
    try {
      LoadedCloud cloud = load();
      check(cloud.sha256);
      return cloud;
    } catch (const DamagedCloud& damaged) {
      check(damaged.sha256());
      std::vector<Fault> faults = damaged.faults();
      for (Fault& fault : faults) fault.message += ", in " + path;
      throw InputError(std::move(faults));
    }
  };
}

}  // namespace

std::vector<InputFile> record_inputs(std::vector<SceneGroup>& groups, const fs::path& data_root,
                                     int jobs) {
  const std::vector<const SensorScan*> scans = scans_with_files(groups);
  std::vector<InputFile> inputs(scans.size());
  const auto kept = std::make_shared<KeptClouds>();
  on_threads(jobs, [&] {
    for_each_in_parallel(
        scans.size(), [&](std::size_t i) { inputs[i] = input_file(*scans[i], data_root, *kept); });
  });
  std::map<std::string, std::size_t> by_file;
  for (std::size_t i = 0; i < scans.size(); ++i) by_file[scans[i]->file] = i;
  const auto hold = [&](SensorScan& scan) {
    if (scan.file.empty()) return;
    const std::size_t i = by_file.at(scan.file);
    // Another scan of the file may load it differently.
    scan.load = held_to(inputs[i], scan, &scan == scans[i] ? kept : nullptr);
  };
  for (SceneGroup& group : groups) {
    for (Scene& scene : group.scenes) {
      hold(scene.reference);
      for (SensorScan& scan : scene.sensors) hold(scan);
    }
  }
  return inputs;
}

}  // namespace croon::experiments

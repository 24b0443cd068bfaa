#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/base/rng.hpp"
#include "framework/geometry/point_cloud.hpp"
#include "framework/spatial/kd_tree.hpp"
#include "framework/spatial/normals.hpp"
#include "framework/spatial/once_table.hpp"

namespace croon {

/// The immutable cloud of one sensor with a cache of everything that depends only on it: kd-tree,
/// normals, ground, a bound scorer, cropped and filtered clouds. Each is computed on first use and
/// shared by all starts, variants and sensors until the scene is done. Thread-safe.
class Cloud {
 public:
  /// `key` names the random streams of computations that depend only on this cloud.
  Cloud(PointCloud cloud, const StreamKey& key)
      : Cloud(std::move(cloud), key, std::make_shared<OnceLog>(), "") {}
  Cloud(const Cloud&) = delete;
  Cloud& operator=(const Cloud&) = delete;

  const Points& points() const { return cloud_.points; }
  /// The points with their channels.
  const PointCloud& with_channels() const { return cloud_; }
  bool empty() const { return cloud_.empty(); }

  /// The kd-tree over points().
  const KdTree& kd_tree() const;
  /// Normals estimated from the `neighbours` nearest points, see Normals.
  const Normals& normals(int neighbours) const;

  /// Any other value that depends only on this cloud and on `parameters`, computed once. `what` is
  /// its name in timings.csv.
  template <class T>
  std::shared_ptr<const T> once(const std::string& what, const std::string& parameters,
                                const std::function<std::shared_ptr<const T>()>& make) const {
    return once_.get<T>(what, parameters, make);
  }
  template <class T>
  std::shared_ptr<const T> once(const std::string& what,
                                const std::function<std::shared_ptr<const T>()>& make) const {
    return once_.get<T>(what, "", make);
  }

  /// A cloud derived from this one for `purpose`: cropped, thinned, without its ground. Its timings
  /// go to the same log.
  std::shared_ptr<const Cloud> derived(PointCloud cloud, const std::string& purpose) const;

  /// The same for a cloud of a single trial, which depends on a pose or a velocity of the trial.
  /// Its computations are not logged: they are work of the step that requests them.
  std::shared_ptr<const Cloud> derived_in_trial(PointCloud cloud, const std::string& purpose) const;

  /// The random generator for a computation that depends only on this cloud; the same for every
  /// trial. `purpose` names the stage and not its parameters, so that variants of a stage draw the
  /// same numbers and a new parameter changes no draw.
  Rng rng(const std::string& purpose) const { return Rng(key_.with(purpose)); }

  /// Everything computed once so far, for this cloud and those derived from it.
  std::vector<OnceTiming> timings() const {
    return log_ ? log_->timings() : std::vector<OnceTiming>();
  }

 private:
  Cloud(PointCloud cloud, const StreamKey& key, std::shared_ptr<OnceLog> log, std::string prefix)
      : cloud_(std::move(cloud)),
        key_(key),
        log_(std::move(log)),
        prefix_(std::move(prefix)),
        once_(log_, prefix_) {}

  PointCloud cloud_;
  StreamKey key_;
  std::shared_ptr<OnceLog> log_;  ///< Null for a cloud of one trial.
  std::string prefix_;            ///< The purpose of this cloud in the log: "ground/ransac/".
  OnceTable once_;
};

}  // namespace croon

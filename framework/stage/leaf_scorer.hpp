#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "framework/spatial/leaf_window.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/volume_scorer.hpp"

namespace croon {

/// The parameters common to all scorers that count leaves.
struct LeafOptions {
  double leaf_size_m = 0.05;
  int leaf_sizes = 1;
  int lattices = 1;
  params::PerAxis lattice_offset_ratio = 0.0;
  int min_points = 1;
};

/// The rows of LeafOptions.
const params::Table<LeafOptions>& leaf_table();

/// The set of leaves of a LeafGrid that the points of a target occupy, for counting the leaves that
/// a source adds. Each scorer implements its own. Thread-safe.
///
/// It is constructed from the grid, the target's points and their pose in the grid's frame. A point
/// outside the grid throws StageError: a point of the target in the constructor, one of the source
/// in leaves_with. `kName` is the name of the stage.
class LeafSet {
 public:
  LeafSet() = default;
  LeafSet(const LeafSet&) = delete;
  LeafSet& operator=(const LeafSet&) = delete;
  virtual ~LeafSet() = default;

  /// The number of leaves with a point of the target, or of the source at `T_grid_source`.
  virtual std::int64_t leaves_with(const PointColumns& source,
                                   const RigidTransform& T_grid_source) const = 0;
};

/// Measures the volume by counting leaves: the mean over all lattices and leaf sizes of
/// LeafOptions. Contains everything that the scorers share; they differ only in how they count.
class LeafScorer : public VolumeScorer {
 public:
  explicit LeafScorer(const LeafOptions& options) : options_(options) {}

  /// The leaves are those of LeafGrid in the target's frame, shifted by the offset of the lattice,
  /// so all scorers count the same. A point outside the grid throws StageError: a point of the
  /// target here, one of the source in the function.
  VolumeFunction bind(std::shared_ptr<const Cloud> target,
                      std::shared_ptr<const Cloud> source) const final;

 private:
  virtual const char* name() const = 0;
  virtual std::shared_ptr<const LeafSet> set_of(const LeafGrid& grid, const PointColumns& target,
                                                const RigidTransform& T_grid_target) const = 0;

  LeafOptions options_;
};

/// The scorer that counts with `Set`, a LeafSet.
template <class Set>
class LeafScorerWith final : public LeafScorer {
 public:
  using LeafScorer::LeafScorer;

 private:
  const char* name() const override { return Set::kName; }
  std::shared_ptr<const LeafSet> set_of(const LeafGrid& grid, const PointColumns& target,
                                        const RigidTransform& T_grid_target) const override {
    return std::make_shared<const Set>(grid, target, T_grid_target);
  }
};

/// The entry of the scorer that counts with `Set`. The other arguments are as in stage_entry.
template <class Set>
StageEntry leaf_scorer_entry(const std::string& summary, const std::string& source,
                             int version = 1) {
  return stage_entry<LeafScorerWith<Set>>(Set::kName, summary, source, leaf_table(), version);
}

}  // namespace croon

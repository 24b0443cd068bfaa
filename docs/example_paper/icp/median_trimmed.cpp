#include <algorithm>
#include <croon/registration/icp_loop.hpp>
#include <croon/stage/icp.hpp>
#include <croon/stage/stage_entry.hpp>

namespace croon::stages::icp {
namespace {

struct Params : IcpOptions {
  int normal_neighbours = 40;
  double max_medians = 3.0;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::integer("normal_neighbours", &Params::normal_neighbours, {3, 1000},
                          "The number of neighbours that a normal of the target is computed from."),
          params::number("max_medians", &Params::max_medians, {1.0, 1000.0},
                         "Correspondences that are longer than this many medians do not count."),
      }
          .inherit(icp_table());
  return table;
}

class MedianTrimmed final : public Icp {
 public:
  explicit MedianTrimmed(Params params) : params_(std::move(params)) {}

  Registration align(const Cloud& target, const Cloud& source,
                     const RigidTransform& start) const override {
    CorrespondenceRule rule;
    rule.target_normals = params_.normal_neighbours;
    rule.select = [this](Correspondences& pairs) { drop_long_ones(pairs); };
    return iterate_icp(target, source, start, params_, rule, point_to_plane_linearisation());
  }

 private:
  void drop_long_ones(Correspondences& pairs) const {
    if (pairs.empty()) return;
    std::vector<double> lengths;
    for (const Correspondence& pair : pairs) lengths.push_back(pair.offset.norm());
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    const double longest = params_.max_medians * *middle;
    const auto is_long = [&](const Correspondence& pair) { return pair.offset.norm() > longest; };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), is_long), pairs.end());
  }

  Params params_;
};

}  // namespace

StageEntry median_trimmed() {
  return stage_entry<MedianTrimmed>(
      "median_trimmed", "Point-to-plane without correspondences that are much longer than most.",
      "an example", table());
}

}  // namespace croon::stages::icp

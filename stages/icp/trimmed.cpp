#include <algorithm>
#include <cmath>

#include "framework/registration/icp_loop.hpp"
#include "framework/stage/icp.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::icp {
namespace {

struct Params : IcpOptions {
  Params() { kernel = Kernel::none; }
  int normal_neighbours = 40;
  double keep_ratio = 0.7;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::integer("normal_neighbours", &Params::normal_neighbours, {3, 1000},
                          "Number of neighbours from which a normal of the target is computed."),
          params::number("keep_ratio", &Params::keep_ratio, {0.01, 1.0},
                         "Share of the correspondences that an iteration uses, the nearest first."),
      }
          .inherit(icp_table());
  return table;
}

/// Keeps the share `ratio` of `pairs` with the smallest distances; of equal ones the first.
void keep_nearest(Correspondences& pairs, double ratio) {
  const auto kept = static_cast<std::size_t>(std::ceil(ratio * static_cast<double>(pairs.size())));
  if (kept >= pairs.size()) return;
  std::vector<double> distances;
  for (const Correspondence& pair : pairs) distances.push_back(pair.offset.squaredNorm());
  std::vector<double> sorted = distances;
  const auto last = sorted.begin() + static_cast<std::ptrdiff_t>(kept) - 1;
  std::nth_element(sorted.begin(), last, sorted.end());
  auto equals = static_cast<std::size_t>(std::count(sorted.begin(), last + 1, *last));
  std::size_t next = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const bool is_equal = distances[i] == *last;
    if (distances[i] > *last || (is_equal && equals == 0)) continue;
    if (is_equal) --equals;
    pairs[next++] = pairs[i];
  }
  pairs.resize(next);
}

class Trimmed final : public Icp {
 public:
  explicit Trimmed(Params params) : params_(std::move(params)) {}

  Registration align(const Cloud& target, const Cloud& source,
                     const RigidTransform& start) const override {
    CorrespondenceRule rule;
    rule.target_normals = params_.normal_neighbours;
    rule.select = [this](Correspondences& pairs) { keep_nearest(pairs, params_.keep_ratio); };
    return iterate_icp(target, source, start, params_, rule, point_to_plane_linearisation());
  }

 private:
  Params params_;
};

}  // namespace

StageEntry trimmed() {
  return stage_entry<Trimmed>(
      "trimmed",
      "Point-to-plane over the nearest correspondences of each iteration, a fixed share of all.",
      "Chetverikov, Stepanov, Krsek: Robust Euclidean alignment of 3D point sets, IVC 2005",
      table());
}

}  // namespace croon::stages::icp

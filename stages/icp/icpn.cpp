#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/registration/icp_loop.hpp"
#include "framework/stage/icp.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::icp {
namespace {

struct Params : IcpOptions {
  int normal_neighbours = 40;
  double max_normal_angle_deg = 60.0;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::integer("normal_neighbours", &Params::normal_neighbours, {3, 1000},
                          "Number of neighbours from which a normal is computed; 40 in the paper."),
          params::number("max_normal_angle_deg", &Params::max_normal_angle_deg, {0.0, 180.0},
                         "Maximum angle between the normals of corresponding points."),
      }
          .inherit(icp_table());
  return table;
}

class Icpn final : public Icp {
 public:
  explicit Icpn(Params params) : params_(std::move(params)) {}

  Registration align(const Cloud& target, const Cloud& source,
                     const RigidTransform& start) const override {
    CorrespondenceRule rule;
    rule.target_normals = params_.normal_neighbours;
    rule.source_normals = params_.normal_neighbours;
    rule.min_normal_cosine = min_cosine_within(params_.max_normal_angle_deg);
    return iterate_icp(target, source, start, params_, rule, point_to_plane_linearisation());
  }

 private:
  Params params_;
};

}  // namespace

StageEntry icpn() {
  return stage_entry<Icpn>("icpn",
                           "Point-to-plane between points with similar normals, each from 40 "
                           "neighbours: the paper's ICP.",
                           "CROON (arXiv 2203.03182), refinement", table(), 2);
}

}  // namespace croon::stages::icp

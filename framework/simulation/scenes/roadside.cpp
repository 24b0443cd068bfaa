#include "framework/simulation/scenes/roadside.hpp"

#include <algorithm>

#include "framework/base/angles.hpp"
#include "framework/simulation/scenes/draws.hpp"

namespace croon::simulation {

Place Roadside::at(double along_m, double out_m, double turn_rad) const {
  if (is_across) {
    return {crossing_s_m + sign * out_m, along_m, -0.5 * kPi * sign + turn_rad};
  }
  return {along_m, sign * out_m, (sign > 0.0 ? 0.0 : kPi) + turn_rad};
}

RoadBox Roadside::box(const Interval& along_m, const Interval& out_m, double height_m) const {
  const Place from = at(along_m.from_m, out_m.from_m);
  const Place to = at(along_m.to_m, out_m.to_m);
  return road_box({std::min(from.s_m, to.s_m), std::max(from.s_m, to.s_m)},
                  {std::min(from.d_m, to.d_m), std::max(from.d_m, to.d_m)}, height_m);
}

double Roadside::along_of(const RoadShape& shape, double length_m, const Interval& out_m) const {
  if (is_across) return length_m;
  return length_m * bend_ratio(shape.curvature_per_m, {sign * out_m.from_m, sign * out_m.to_m});
}

std::array<Roadside, 2> both_sides() {
  Roadside left;
  Roadside right;
  right.sign = -1.0;
  return {left, right};
}

void add_series(SceneBuilder& builder, const Roadside& side, const Interval& along_m,
                const Series& series, Rng rng) {
  std::vector<Mesh> looks;
  for (int i = 0; i < series.looks; ++i) looks.push_back(series.make(rng));
  double place_m = along_m.from_m + rng.uniform(0.0, series.spacing_m.from_m);
  while (place_m < along_m.to_m) {
    const double out_m = draw(rng, series.out_m);
    const double turn_rad = series.is_turned_anyhow ? rng.uniform(0.0, 2.0 * kPi) : series.turn_rad;
    if (chance(rng, series.share)) {
      builder.stand(pick(looks, rng), side.at(place_m, out_m, turn_rad));
    }
    place_m += draw(rng, series.spacing_m);
  }
}

Mesh centred_along_x(Mesh mesh) {
  Eigen::AlignedBox3f bounds;
  for (const Eigen::Vector3f& vertex : mesh.vertices) bounds.extend(vertex);
  const float middle_m = bounds.center().x();
  for (Eigen::Vector3f& vertex : mesh.vertices) vertex.x() -= middle_m;
  return mesh;
}

}  // namespace croon::simulation

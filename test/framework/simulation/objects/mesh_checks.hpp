#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <memory>

#include "framework/base/rng.hpp"
#include "framework/simulation/ray_caster.hpp"

namespace croon::simulation::test {

/// The least box around the vertices of `mesh`.
Eigen::AlignedBox3d bounds_of(const Mesh& mesh);

/// Expects at most `most` triangles, each with a material, an area and corners that exist, and
/// finite vertices.
void expect_sound(const Mesh& mesh, std::size_t most);

/// Expects the same bits of `make` for the same seed and others for another.
void expect_drawn_from_its_rng(const std::function<Mesh(Rng&)>& make);

/// What casts rays at `mesh` alone.
std::unique_ptr<RayCaster> caster_of(const Mesh& mesh);

}  // namespace croon::simulation::test

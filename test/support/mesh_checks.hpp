#pragma once

#include <cstddef>
#include <functional>

#include "framework/base/rng.hpp"
#include "framework/simulation/mesh.hpp"

namespace croon::test {

/// Expects as many materials as triangles, corners that exist, and finite vertices.
void expect_whole(const simulation::Mesh& mesh);

/// Expects a whole mesh of 1 to `most` triangles, all of which but `flat` have an area.
void expect_sound(const simulation::Mesh& mesh, std::size_t most, std::size_t flat = 0);

/// True if the two meshes have the same bits.
bool are_same(const simulation::Mesh& a, const simulation::Mesh& b);

/// Expects the same bits of `make` for the same seed and others for another.
void expect_drawn_from_its_rng(const std::function<simulation::Mesh(Rng&)>& make);

/// Expects that `mesh` stops rays from all around that aim at `inside`.
void expect_closed_around(const simulation::Mesh& mesh, const Eigen::Vector3d& inside, Rng& rng);

}  // namespace croon::test

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// Red, green, blue.
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
};

/// The colour of the sensor `index`, the reference being 0: grey, then the palette of Okabe and Ito
/// (2008), which colour-blind readers can tell apart; it starts again after eight.
Colour sensor_colour(std::size_t index);

/// One sensor's cloud in its own frame, to be drawn in the reference's.
struct ColouredCloud {
  std::string sensor;
  PointCloud points;
  RigidTransform T_reference_sensor;
};

enum class PlyFormat { binary_little_endian, ascii };

/// Writes a cloud as PLY with x, y, z; ascii numbers are the shortest that read back as the same
/// floats. Throws InputError where the file cannot be written.
void write_ply(const std::filesystem::path& path, const PointCloud& cloud,
               PlyFormat format = PlyFormat::binary_little_endian);

/// Writes all clouds of a rig in the reference's frame into one PLY, each in the colour of its
/// place in `clouds`; comments in the header say which is which.
void write_fused_ply(const std::filesystem::path& path, const std::vector<ColouredCloud>& clouds);

}  // namespace croon

#include "framework/io/vdb_writer.hpp"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <sstream>

#include "framework/base/whole_file.hpp"
#include "framework/io/digest.hpp"
#include "framework/spatial/leaf_grid.hpp"

namespace croon {
namespace {

/// The active voxels are true: bool grids are what most viewers draw.
openvdb::BoolGrid::Ptr occupancy_grid(const Points& points, double leaf_size_m) {
  const LeafGrid leaves(leaf_size_m);
  openvdb::BoolGrid::Ptr grid = openvdb::BoolGrid::create(false);
  openvdb::BoolGrid::Accessor voxels = grid->getAccessor();
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Vector3i leaf = leaves.leaf_of(p.cast<double>());
    voxels.setValueOn(openvdb::Coord(leaf.x(), leaf.y(), leaf.z()), true);
  }
  // A voxel's centre is at its integer index, a leaf's half a leaf beyond it.
  openvdb::math::Transform::Ptr transform =
      openvdb::math::Transform::createLinearTransform(leaf_size_m);
  transform->postTranslate(openvdb::Vec3d(0.5 * leaf_size_m));
  grid->setTransform(transform);
  grid->setName("occupancy");
  return grid;
}

/// OpenVDB gives each file a random UUID; replaces it by one that is derived from the content.
void name_by_content(std::string& bytes) {
  // After the magic number, the version of the format, that of the library, and a flag.
  constexpr std::size_t kUuidOffset = 8 + 4 + 2 * 4 + 1;
  bytes.replace(kUuidOffset, 36, "00000000-0000-0000-0000-000000000000");
  std::string uuid = sha256_of_text(bytes).substr(0, 32);
  for (const std::size_t hyphen : {8, 13, 18, 23}) uuid.insert(hyphen, "-");
  bytes.replace(kUuidOffset, uuid.size(), uuid);
}

}  // namespace

void write_occupancy_vdb(const std::filesystem::path& path, const Points& points,
                         double leaf_size_m) {
  openvdb::initialize();
  std::ostringstream stream(std::ios_base::binary);
  openvdb::io::Stream(stream).write(openvdb::GridCPtrVec{occupancy_grid(points, leaf_size_m)});
  std::string bytes = stream.str();
  name_by_content(bytes);
  write_whole_file(path, bytes);
}

}  // namespace croon

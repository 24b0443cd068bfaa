#include "framework/io/vdb_writer.hpp"

#include "framework/base/whole_file.hpp"
#include "framework/io/digest.hpp"
#include "framework/openvdb/voxels.hpp"
#include "framework/spatial/leaf_grid.hpp"

namespace croon {
namespace {

/// Replaces the random UUID that OpenVDB writes by one derived from the content.
void name_by_content(std::string& bytes) {
  // After the magic number, the format version, the library version and a flag.
  constexpr std::size_t kUuidOffset = 8 + 4 + 2 * 4 + 1;
  bytes.replace(kUuidOffset, 36, "00000000-0000-0000-0000-000000000000");
  std::string uuid = sha256_of_text(bytes).substr(0, 32);
  for (const std::size_t hyphen : {8, 13, 18, 23}) uuid.insert(hyphen, "-");
  bytes.replace(kUuidOffset, uuid.size(), uuid);
}

}  // namespace

void write_occupancy_vdb(const std::filesystem::path& path, const Points& points,
                         double leaf_size_m) {
  const LeafGrid grid(leaf_size_m);
  voxels::Indices leaves;
  leaves.reserve(points.size());
  for (const Eigen::Vector3f& point : points) leaves.push_back(grid.leaf_of(point.cast<double>()));
  std::string bytes = voxels::occupancy_file(leaves, leaf_size_m);
  name_by_content(bytes);
  write_whole_file(path, bytes);
}

}  // namespace croon

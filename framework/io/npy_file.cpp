#include "framework/io/npy_file.hpp"

#include "framework/base/error.hpp"
#include "framework/io/cloud_columns.hpp"
#include "framework/io/npy_header.hpp"
#include "framework/io/text_scan.hpp"
#include "framework/io/zip_archive.hpp"

namespace croon {

LoadedCloud parse_npy(std::string_view bytes, const std::string& file,
                      const Eigen::Vector3d& origin_m) {
  const NpyHeader header = parse_npy_header(bytes, file);
  check_npy_size(header, bytes.size(), file);
  const auto column = [&](const NpyField& field, const std::string& name) {
    return CloudColumn{name,         field.type,
                       field.count,  bytes.data() + header.body_offset + field.first_byte,
                       field.stride, field.order};
  };
  std::array<CloudColumn, 3> xyz;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    xyz[axis] = column(header.fields[header.xyz[axis]], "");
  }
  const std::vector<std::string> names = npy_channel_names(header);
  std::vector<CloudColumn> channels;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].empty()) channels.push_back(column(header.fields[i], names[i]));
  }
  LoadedCloud cloud;
  cloud.origin_m = origin_m;
  return from_columns(std::move(cloud), header.points, xyz, channels);
}

std::string npy_of_npz(std::string_view bytes, const std::string& file) {
  constexpr std::string_view kSuffix = ".npy";
  std::vector<ZipEntry> arrays;
  std::string names;
  for (const ZipEntry& entry : zip_entries(bytes, file)) {
    const std::size_t size = entry.name.size();
    if (size < kSuffix.size() || entry.name.substr(size - kSuffix.size()) != kSuffix) continue;
    arrays.push_back(entry);
    names += (names.empty() ? "" : ", ") + in_quotes(entry.name.substr(0, size - kSuffix.size()));
  }
  for (const char* name : {"points.npy", "xyz.npy"}) {
    for (const ZipEntry& entry : arrays) {
      if (entry.name == name) return zip_content(bytes, entry, file);
    }
  }
  if (arrays.size() == 1) return zip_content(bytes, arrays.front(), file);
  throw InputError(file, "",
                   "expected one array, or one named \"points\" or \"xyz\", found " +
                       (arrays.empty() ? "none" : names));
}

}  // namespace croon

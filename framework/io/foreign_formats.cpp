#include "framework/io/foreign_formats.hpp"

#include <cctype>
#include <iterator>

namespace croon {
namespace {

/// An unsupported format: the first bytes of its files, its suffix in lower case, and how to
/// convert them.
struct ForeignFormat {
  std::string_view magic;
  std::string_view suffix;
  const char* advice;
};

constexpr const char* kLas = "a LAS file; convert it: pdal translate in.las out.csv";
constexpr const char* kLaz = "a LAZ file; convert it: pdal translate in.laz out.csv";
constexpr const char* kE57 = "an E57 file; convert it: pdal translate in.e57 out.csv";
constexpr const char* kPcap =
    "a capture of network packets; replay it with the driver of the LiDAR and record its clouds as "
    "a rosbag2, or save one scan as PCD or CSV in the maker's viewer";
constexpr const char* kRosBag =
    "a ROS 1 bag; convert it: rosbags-convert --src in.bag --dst out (pip install rosbags), then "
    "pass the folder to croon calibrate";
constexpr const char* kRecording =
    "a recording of many messages instead of one cloud; pass it to croon calibrate";
constexpr const char* kMesh =
    "a mesh instead of measured points; convert its vertices: CloudCompare -SILENT -O in.obj "
    "-EXTRACT_VERTICES -C_EXPORT_FMT PLY -SAVE_CLOUDS";
constexpr const char* kCloudCompare =
    "a CloudCompare file; convert it: CloudCompare -SILENT -O in.bin -C_EXPORT_FMT PLY "
    "-SAVE_CLOUDS";
constexpr const char* kImage = "an image instead of a point cloud";
constexpr const char* kZip = "a compressed archive; unpack it";
constexpr const char* kPython =
    "a Python object; save its points with numpy.save(\"out.npy\", points)";
constexpr const char* kHdf =
    "an HDF5 file; save its points in Python with numpy.save(\"out.npy\", dataset[:])";
constexpr const char* kTable =
    "a table; save its columns x, y, z as CSV: pandas.read_parquet(\"in\").to_csv(\"out.csv\", "
    "index=False), read_feather for Feather";
constexpr const char* kMatlab =
    "a MATLAB file; save the points in it: pcwrite(pointCloud(xyz), 'out.pcd')";

/// Magic numbers are checked first, because they are unambiguous.
constexpr ForeignFormat kFormats[] = {
    {"ASTM-E57", ".e57", kE57},
    {"#ROSBAG V", ".bag", kRosBag},
    {"\x89MCAP", ".mcap", kRecording},
    {"SQLite format 3", ".db3", kRecording},
    {"\xD4\xC3\xB2\xA1", ".pcap", kPcap},
    {"\xA1\xB2\xC3\xD4", "", kPcap},
    {"\x4D\x3C\xB2\xA1", "", kPcap},
    {"\xA1\xB2\x3C\x4D", "", kPcap},
    {"\x0A\x0D\x0D\x0A", ".pcapng", kPcap},
    {"CCB", "", kCloudCompare},
    {"\x89PNG", ".png", kImage},
    {"\xFF\xD8\xFF", ".jpg", kImage},
    {"\x1F\x8B", ".gz", kZip},
    {"\x28\xB5\x2F\xFD", ".zst", kZip},
    {"BZh", ".bz2", kZip},
    {"\xFD"
     "7zXZ",
     ".xz", kZip},
    {"\x89HDF", ".h5", kHdf},
    {"PAR1", ".parquet", kTable},
    {"ARROW1", ".feather", kTable},
    {"MATLAB 5.0", ".mat", kMatlab},
    {"", ".laz", kLaz},
    {"LASF", ".las", kLas},
    {"", ".obj", kMesh},
    {"", ".stl", kMesh},
    {"", ".off", kMesh},
    {"", ".gltf", kMesh},
    {"", ".glb", kMesh},
    {"", ".ptx",
     "a PTX file; convert it: CloudCompare -SILENT -O in.ptx -C_EXPORT_FMT PLY -SAVE_CLOUDS"},
    {"", ".rcp", "a ReCap project; export its scans from ReCap as PTS or E57"},
    {"", ".rcs", "a ReCap scan; export it from ReCap as PTS or E57"},
    {"", ".lvx", "a recording of Livox Viewer; export a scan from it as PCD, or CSV"},
    {"", ".lvx2", "a recording of Livox Viewer 2; export a scan from it as PCD, or CSV"},
    {"", ".pkl", kPython},
    {"", ".pickle", kPython},
    {"", ".pt", kPython},
    {"", ".hdf5", kHdf},
    {"", ".jpeg", kImage},
    {"", ".zip", kZip},
};

}  // namespace

std::string foreign_format(std::string_view head, const std::filesystem::path& path) {
  std::string suffix = path.extension().string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  // A LAZ file begins like a LAS file.
  if (head.substr(0, 4) == "LASF") return suffix == ".laz" ? kLaz : kLas;
  for (const ForeignFormat& format : kFormats) {
    const bool has_magic =
        !format.magic.empty() && head.substr(0, format.magic.size()) == format.magic;
    if (has_magic) return format.advice;
  }
  for (const ForeignFormat& format : kFormats) {
    if (!format.suffix.empty() && suffix == format.suffix) return format.advice;
  }
  return "";
}

}  // namespace croon

#include "experiments/report/timings_file.hpp"

#include <sstream>
#include <unordered_set>

#include "experiments/report/report_files.hpp"
#include "experiments/report/result_tables.hpp"
#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"

namespace croon::experiments {
namespace {

/// Makes the file end after its last whole line, or hold the header alone.
void repair(const std::filesystem::path& path) {
  const std::string header = timings_csv({});
  std::string bytes;
  if (std::filesystem::exists(path)) bytes = read_whole_file(path);
  if (bytes.compare(0, header.size(), header) != 0) return write_whole_file(path, header);
  if (bytes.back() != '\n') write_whole_file(path, bytes.substr(0, bytes.rfind('\n') + 1));
}

}  // namespace

TimingsFile::TimingsFile(const std::filesystem::path& path) : path_(path) {
  repair(path);
  stream_.open(path, std::ios::binary | std::ios::app);
  if (!stream_) throw InputError(path.string(), "", "cannot be written");
}

void TimingsFile::add(const std::vector<TimingRow>& rows) {
  stream_ << timings_csv(rows).substr(timings_csv({}).size());
}

void TimingsFile::flush() {
  stream_ << std::flush;
  if (!stream_) throw InputError(path_.string(), "", "cannot be written");
}

void merge_timings(const std::vector<std::filesystem::path>& folders,
                   const std::filesystem::path& path) {
  std::string merged = timings_csv({});
  std::unordered_set<std::string> rows = {merged.substr(0, merged.size() - 1)};
  for (const std::filesystem::path& folder : folders) {
    if (!std::filesystem::exists(folder / kTimings)) continue;
    std::istringstream bytes(read_whole_file(folder / kTimings));
    for (std::string row; std::getline(bytes, row);) {
      if (!bytes.eof() && rows.insert(row).second) merged += row + "\n";
    }
  }
  write_whole_file(path, merged);
}

}  // namespace croon::experiments

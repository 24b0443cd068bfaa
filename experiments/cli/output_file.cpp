#include "experiments/cli/output_file.hpp"

#include "experiments/cli/output_folder.hpp"
#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"

namespace croon::experiments {

void write_output_file(const std::filesystem::path& path, const std::string& bytes,
                       const std::filesystem::path& input) {
  std::error_code error;
  const bool is_input = std::filesystem::equivalent(path, input, error);
  const bool is_store = path.filename() == store_path("").filename();
  if (is_input || (is_store && std::filesystem::exists(path, error))) {
    throw InputError("", "--out",
                     "expected a file to write, found " + path.string() + ", " +
                         (is_store ? "the store of a run" : "which is read"));
  }
  write_whole_file(path, bytes);
}

}  // namespace croon::experiments

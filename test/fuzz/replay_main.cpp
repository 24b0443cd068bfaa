// Gives every file of the folders on the command line to a fuzz target, so that the corpora are
// tests of every build and not of the fuzzers alone. No file is a failure: the corpus is gone.
#include <cstdio>
#include <filesystem>
#include <set>

#include "framework/base/whole_file.hpp"
#include "test/fuzz/fuzz_input.hpp"

int main(int count, char** arguments) {
  std::set<std::filesystem::path> files;
  for (int i = 1; i < count; ++i) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(arguments[i])) {
      if (entry.is_regular_file()) files.insert(entry.path());
    }
  }
  for (const std::filesystem::path& file : files) {
    std::printf("%s\n", file.c_str());
    std::fflush(stdout);
    const std::string bytes = croon::read_whole_file(file);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  std::printf("%zu inputs\n", files.size());
  return files.empty() ? 1 : 0;
}

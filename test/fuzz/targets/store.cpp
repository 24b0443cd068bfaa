// Stores of results: SQLite files, read, summarised and checked as `croon export` does.
#include "experiments/store/store.hpp"
#include "experiments/analysis/results.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  const std::filesystem::path path = fuzz::write_input("store.sqlite", data, size);
  fuzz::is_taken([&] {
    experiments::read_results(path.parent_path(), experiments::Content::trials_and_steps);
  });
  return 0;
}

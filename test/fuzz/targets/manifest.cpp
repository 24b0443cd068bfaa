// Manifests of folders of results, as `croon merge` reads them.
#include "experiments/store/manifest.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  const std::filesystem::path path = fuzz::write_input("manifest.json", data, size);
  fuzz::is_taken([&] { experiments::hosts_json({path.parent_path()}); });
  return 0;
}

// Experiment files, as users write them and as the store keeps them. What is read, written and read
// again is the same experiment.
#include "experiments/file/experiment.hpp"

#include <nlohmann/json.hpp>

#include "registry/registry.hpp"
#include "test/fuzz/fuzz_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace croon;
  using namespace croon::experiments;
  using nlohmann::json;
  const std::filesystem::path path = fuzz::write_input("experiment.json", data, size);
  const std::string text(reinterpret_cast<const char*>(data), size);
  fuzz::is_taken([&] { read_experiment_json(json::parse(text, nullptr, false), "store"); });
  Experiment experiment;
  if (!fuzz::is_taken([&] { experiment = load_experiment(path, registry()); })) return 0;
  const json canonical = experiment_json(experiment);
  Experiment again = read_experiment_json(canonical, "store");
  // The store has these two beside the text.
  again.variants = experiment.variants;
  again.starts.trials = experiment.starts.trials;
  fuzz::require(json(experiment_json(again)) == canonical, "an experiment is read back as another");
  return 0;
}

#include "experiments/cli/commands.hpp"

#include <algorithm>
#include <memory>
#include <string>

#include "experiments/analysis/results.hpp"
#include "experiments/cli/command.hpp"
#include "experiments/cli/options.hpp"
#include "experiments/report/result_sections.hpp"
#include "framework/document/renderers.hpp"

namespace croon::experiments {
namespace {

constexpr const char* kHead =
    "The claims of experiments, the band in which each number must lie, and the number found. "
    "Angles in degrees, lengths in\nmetres. \"All sensors\" pools the trials of all sensors.\n";

bool is_met(const ClaimResult& claim) {
  return claim.outcome == ClaimOutcome::in || claim.outcome == ClaimOutcome::shown;
}

}  // namespace

int claims_command(const std::vector<std::filesystem::path>& folders, std::ostream& out) {
  refuse_repeats(folders);
  std::string text = kHead;
  bool are_met = true;
  for (const std::filesystem::path& folder : folders) {
    const Results results = read_results(folder);
    text += "\n" + markdown_section(claims_page(results));
    are_met = are_met && std::all_of(results.claims.begin(), results.claims.end(), is_met);
  }
  out << text;
  return are_met ? 0 : 3;
}

namespace {

class ClaimsCommand final : public Command {
 public:
  std::string sentence() const override {
    return "Check results against the claims of their experiments.";
  }

  void add_options(CLI::App& command) override {
    add_path(command, "DIR", folders_, "Folders of results.")->required();
  }

  int run(const Console& console) override { return claims_command(folders_, console.out); }

 private:
  std::vector<std::filesystem::path> folders_;
};

}  // namespace

std::unique_ptr<Command> make_claims_command() { return std::make_unique<ClaimsCommand>(); }

}  // namespace croon::experiments

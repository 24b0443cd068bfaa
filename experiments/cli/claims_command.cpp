#include "experiments/cli/claims_command.hpp"

#include <algorithm>
#include <string>

#include "experiments/cli/results_folder.hpp"
#include "experiments/report/claims.hpp"
#include "experiments/report/export_formats.hpp"

namespace croon::experiments {
namespace {

constexpr const char* kHead =
    "What experiments expect, the band in which each number must lie, and what was found. Angles "
    "in degrees, lengths in\nmetres. \"All sensors\" pools the trials of all of them.\n";

/// What was run, in a table of one row.
std::string run_table(const Results& results) {
  const std::string trials =
      std::to_string(results.records.size()) + " of " + std::to_string(results.planned);
  return "| scenes | sensors | starts of each | trials | seed | commit "
         "|\n|---|---|---|---|---|---|\n"
         "| " +
         std::to_string(results.scenes) + " | " +
         std::to_string(sensors_of(results.summary).size()) + " | " +
         std::to_string(results.trials) + " | " + trials + " | " + std::to_string(results.seed) +
         " | " + results.commit + " |\n";
}

std::string section(const Results& results) {
  std::string text = "\n## " + markdown_escaped(results.name) + "\n\n";
  if (!results.description.empty()) text += markdown_escaped(results.description) + "\n\n";
  text += run_table(results) + "\n";
  const std::string tables = claims_markdown(results.claims, results.quoted, results.summary);
  return text + (tables.empty() ? "The experiment expects nothing.\n" : tables);
}

bool is_met(const ClaimResult& claim) { return claim.verdict == Verdict::in; }

}  // namespace

int claims_command(const std::vector<std::filesystem::path>& folders, std::ostream& out) {
  std::string text = kHead;
  bool are_met = true;
  for (const std::filesystem::path& folder : folders) {
    const Results results = read_results(folder);
    text += section(results);
    are_met = are_met && std::all_of(results.claims.begin(), results.claims.end(), is_met);
  }
  out << text;
  return are_met ? 0 : 3;
}

}  // namespace croon::experiments

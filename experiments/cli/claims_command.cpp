#include "experiments/cli/claims_command.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "experiments/cli/results_folder.hpp"
#include "experiments/report/claims.hpp"
#include "framework/base/error.hpp"

namespace croon::experiments {
namespace {

constexpr const char* kHead =
    "<!-- Written by `croon claims`; `experiments/paper/reproduce.sh` writes it again. -->\n\n"
    "# Reproduction\n\n"
    "Numbers that the paper (CROON, arXiv 2203.03182) claims, and ours: what was expected, the "
    "band in which ours\nmust lie, what was found. A number outside its band is said to be out; no "
    "band was widened to hold it.\nAngles in degrees, lengths in metres. \"All sensors\" pools the "
    "trials of all of them.\n";

/// What was run, in a table of one row.
std::string run_table(const Results& results) {
  std::set<std::string> sensors;
  for (const SummaryRow& row : results.summary.rows) sensors.insert(row.sensor);
  const std::string trials =
      std::to_string(results.records.size()) + " of " + std::to_string(results.planned);
  return "| scenes | sensors | starts of each | trials | seed | commit "
         "|\n|---|---|---|---|---|---|\n"
         "| " +
         std::to_string(results.scenes) + " | " + std::to_string(sensors.size()) + " | " +
         std::to_string(results.trials) + " | " + trials + " | " + std::to_string(results.seed) +
         " | " + results.commit + " |\n";
}

std::string section(const Results& results, const std::vector<ClaimResult>& claims) {
  std::string text = "\n## " + results.name + "\n\n";
  if (!results.description.empty()) text += results.description + "\n\n";
  text += run_table(results) + "\n";
  const std::string tables = claims_markdown(claims, results.claims.quoted, results.summary);
  return text + (tables.empty() ? "The experiment expects nothing.\n" : tables);
}

bool is_out(const ClaimResult& claim) { return claim.verdict == Verdict::out; }

}  // namespace

int claims_command(const std::vector<std::filesystem::path>& folders, std::ostream& out) {
  std::string text = kHead;
  bool is_any_out = false;
  for (const std::filesystem::path& folder : folders) {
    const Results results = read_results(folder);
    const std::vector<ClaimResult> claims = check_claims(results.claims.expect, results.summary);
    text += section(results, claims);
    is_any_out = is_any_out || std::any_of(claims.begin(), claims.end(), is_out);
  }
  if (!(out << text).flush()) throw InputError("", "standard output", "cannot be written");
  return is_any_out ? 3 : 0;
}

}  // namespace croon::experiments

#include <algorithm>

#include "experiments/report/csv_row.hpp"
#include "experiments/report/export_table.hpp"

namespace croon::experiments {

namespace {

constexpr std::size_t kShownDigits = 12;

/// "12 scenes", "1 scene".
std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// The first digits of a commit; that it had been changed stays.
std::string short_commit(const std::string& commit) {
  const std::size_t dash = std::min(commit.find('-'), commit.size());
  return commit.substr(0, std::min(dash, kShownDigits)) + commit.substr(dash);
}

bool has_reference(const ExportTable& table, Reference reference) {
  return std::any_of(table.rows.begin(), table.rows.end(),
                     [&](const ExportRow& row) { return row.reference == reference; });
}

/// "2 scenes, 4 sensors, 2 variants, 10 starts of each: 160 trials."
std::string counts_sentence(const ExportTable& table) {
  const ExportCaption& caption = table.caption;
  std::string text =
      counted(caption.scenes, "scene") + ", " + counted(table.sensors.size(), "sensor") + ", ";
  if (table.variants.size() > 1) text += counted(table.variants.size(), "variant") + ", ";
  text += counted(static_cast<std::size_t>(caption.starts), "start") + " of each: ";
  if (caption.found < caption.planned) text += std::to_string(caption.found) + " of ";
  return text + counted(caption.planned, "trial") + ".";
}

}  // namespace

std::vector<std::string> caption_sentences(const ExportTable& table) {
  std::vector<std::string> sentences = {table.caption.name + " (croon, commit " +
                                            short_commit(table.caption.commit) + ", seed " +
                                            std::to_string(table.caption.seed) + ").",
                                        counts_sentence(table)};
  const std::string bounds = "within " + shortest_number(table.bounds.rotation_deg) + " deg and " +
                             shortest_number(table.bounds.translation_m) + " m of ";
  if (has_reference(table, Reference::truth)) {
    sentences.push_back("Success: " + bounds + "the truth; errors are those of these trials.");
  }
  if (has_reference(table, Reference::consensus)) {
    sentences.push_back("Success, where there is no truth: " + bounds +
                        "what the trials of the scene agree on; deviations of these trials from "
                        "what all scenes agree on.");
  }
  sentences.emplace_back("Interval: 95 % (Wilson).");
  if (table.variants.size() > 1) {
    sentences.emplace_back(
        "Bold: the best of the sensor, for errors among those that no other beats in success.");
  }
  if (!table.base.empty()) {
    sentences.push_back("*: differs from " + table.base +
                        " over the same trials, those without a usable result as infinite errors "
                        "(McNemar, Wilcoxon; p < 0.05 after Holm), + for the better, - for the "
                        "worse; **: also with scenes as units.");
  }
  return sentences;
}

}  // namespace croon::experiments

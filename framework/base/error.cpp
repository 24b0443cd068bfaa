#include "framework/base/error.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "framework/base/text.hpp"

namespace croon {
namespace {

std::string joined_lines(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) {
    if (!text.empty()) text += '\n';
    text += fault.line();
  }
  return text;
}

/// Levenshtein's edit distance, one row at a time.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

}  // namespace

std::string Fault::line() const {
  // Partly the user's text, of any length and with any bytes.
  constexpr std::size_t kMaxWhereColumns = 200;
  constexpr std::size_t kMaxMessageColumns = 2000;
  std::string text;
  if (!file.empty()) text += cut_in_the_middle(printable(file), kMaxMessageColumns) + ": ";
  if (!where.empty()) text += cut_in_the_middle(printable(where), kMaxWhereColumns) + ": ";
  return text + cut_in_the_middle(printable(message), kMaxMessageColumns);
}

void collect_faults(std::vector<Fault>& faults, const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    faults.insert(faults.end(), error.faults().begin(), error.faults().end());
  }
}

void add_note(std::vector<Fault>& notes, const Fault& note) {
  const auto has_message = [&](const Fault& other) { return other.message == note.message; };
  if (std::none_of(notes.begin(), notes.end(), has_message)) notes.push_back(note);
}

std::vector<Fault> without_repeats(const std::vector<Fault>& faults) {
  std::vector<Fault> once;
  std::set<std::string> lines;
  for (const Fault& fault : faults) {
    if (lines.insert(fault.line()).second) once.push_back(fault);
  }
  return once;
}

InputError::InputError(std::vector<Fault> faults)
    : std::runtime_error(joined_lines(faults)), faults_(std::move(faults)) {}

InputError::InputError(std::string file, std::string where, std::string message)
    : InputError(std::vector<Fault>{Fault{std::move(file), std::move(where), std::move(message)}}) {
}

std::string nearest_name(const std::string& name, const std::vector<std::string>& known) {
  // The user's text may have any length; no known name is this long.
  constexpr std::size_t kMaxNameLength = 200;
  std::string best;
  if (name.size() > kMaxNameLength) return best;
  // Allows two swapped letters in a short word, and up to half of a long word to differ.
  std::size_t min_distance = std::min(name.size(), std::max<std::size_t>(2, name.size() / 2) + 1);
  for (const std::string& candidate : known) {
    // The distance is at least the difference of the lengths.
    const auto [shorter, longer] = std::minmax({name.size(), candidate.size()});
    if (longer - shorter >= min_distance) continue;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < min_distance) {
      min_distance = distance;
      best = candidate;
    }
  }
  return best;
}

namespace {

/// The only name in `known` that begins with `name`, as "voxel_size_m" begins with "voxel"; empty
/// if there is none, if there are several, or if `name` is shorter than three letters.
std::string completed_name(const std::string& name, const std::vector<std::string>& known) {
  constexpr std::size_t kMinWordLength = 3;
  std::string found;
  if (name.size() < kMinWordLength) return found;
  for (const std::string& candidate : known) {
    if (candidate.compare(0, name.size(), name) != 0) continue;
    if (!found.empty()) return "";
    found = candidate;
  }
  return found;
}

}  // namespace

std::string name_hint(const std::string& name, const std::vector<std::string>& known) {
  if (known.empty()) return "";
  std::string near = nearest_name(name, known);
  if (near.empty()) near = completed_name(name, known);
  if (!near.empty()) return "; did you mean \"" + near + "\"?";
  return "; known: " + list_text(known);
}

}  // namespace croon

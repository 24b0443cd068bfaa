#include "framework/calibration/reasons_in_words.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "framework/base/text.hpp"
#include "framework/geometry/dof.hpp"

namespace croon {
namespace {

/// Maps a reason of a step, recognised by how it begins, to a sentence and advice for users. In
/// `sentence`, `{1}` and `{2}` are the first and second number of the reason, `{1%}` and `{2%}` the
/// same as percentages.
struct Translation {
  const char* begins;
  const char* sentence;
  const char* advice;
};

constexpr const char* kAtRest =
    "Record while the vehicle is at rest and little else moves, or with the time of each point.";
constexpr const char* kOtherPlace =
    "Record at another place, where the surroundings do not look the same after a rotation or "
    "shift, or supply nominal poses.";
constexpr const char* kMoreScenes =
    "Record several scenes at different places and calibrate from all of them.";
constexpr const char* kSlower = "Drive more slowly, or record while the vehicle is at rest.";

constexpr Translation kTranslations[] = {
    {"the overlap with agreeing surfaces",
     "Only {1%} of the points that both sensors should see agree; at least {2%} is required.",
     kMoreSharedView},
    {"the share of points in free space",
     "{1%} of the points lie in the other sensor's free space; at most {2%} is allowed.", kAtRest},
    {"at the initial pose, the share of points in free space",
     "At the pose of the search, {1%} of the points lie in the other sensor's free space, so it is "
     "wrong.",
     kMoreSharedView},
    {"no surfaces touch", "No surface is seen by both sensors, so nothing constrains the pose.",
     kMoreSharedView},
    {"the rotation between two halves",
     "Two halves of the points lead to poses {1} degrees apart; at most {2} degrees are allowed.",
     kMoreScenes},
    {"the distance between two halves",
     "Two halves of the points lead to poses {1} m apart; at most {2} m are allowed.", kMoreScenes},
    {"the standard deviation of the speed",
     "The speed during the scan is uncertain, by {1} m/s, and another speed explains the clouds "
     "nearly as well.",
     kSlower},
    {"motion during the scans explains the clouds better",
     "The vehicle moved during the scan, by {1} m and {2} degrees per revolution, and without "
     "usable times this cannot be corrected.",
     kAtRest},
    {"motion during the scans cannot be excluded",
     "The vehicle may have moved during the scan, which would shift the pose.", kAtRest},
    {"the planes of all sensors would move it",
     "It contradicts the other sensors: the planes that all of them see would move it by {1} "
     "degrees and {2} m.",
     kMoreScenes},
    {"no pose was found at which the clouds agree", "No pose was found at which the clouds agree.",
     kMoreSharedView},
    {"inlier ratio", "Only {1%} of the points have a counterpart; at least {2%} is required.",
     kMoreSharedView},
};

/// The numbers in `text`, as written.
std::vector<std::string> numbers_in(const std::string& text) {
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < text.size();) {
    const bool is_signed = text[i] == '-' && i + 1 < text.size() && std::isdigit(text[i + 1]) != 0;
    if (!is_signed && std::isdigit(static_cast<unsigned char>(text[i])) == 0) {
      ++i;
      continue;
    }
    const std::size_t end = std::min(text.find_first_not_of("0123456789.", i + 1), text.size());
    numbers.push_back(text.substr(i, end - i));
    i = end;
  }
  return numbers;
}

void replace(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at != std::string::npos) text.replace(at, from.size(), to);
}

std::string with_numbers(std::string sentence, const std::vector<std::string>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::string key = "{" + std::to_string(i + 1);
    const double number = std::strtod(numbers[i].c_str(), nullptr);
    replace(sentence, key + "%}", fixed_number(100.0 * number, 1) + " %");
    replace(sentence, key + "}", plain_number(number));
  }
  return sentence;
}

/// Advice for an unconstrained degree of freedom.
std::string advice_for(Dof dof) {
  switch (dof) {
    case Dof::x:
    case Dof::y:
      return "Record next to walls that face along " + kDofNames.at(static_cast<std::size_t>(dof)) +
             " of the reference (for the direction of travel: house fronts across the road, a "
             "crossing, parked trucks).";
    case Dof::z:
      return "Record on a road or yard that both sensors see, or below a roof or bridge.";
    case Dof::yaw:
      return "Record next to walls or poles that both sensors see: the ground alone does not "
             "constrain yaw.";
    default:
      return "Record where both sensors see the ground or other surfaces far apart, to constrain " +
             kDofNames.at(static_cast<std::size_t>(dof)) + ".";
  }
}

void add_once(std::vector<std::string>& list, const std::string& text) {
  if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
}

/// The words of `text` between spaces and commas.
std::vector<std::string> words_in(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    if (c != ' ' && c != ',') {
      words.back() += c;
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  return words;
}

/// "not constrained: x and yaw (strength 0.001, below 0.010)".
bool add_unconstrained(const std::string& reason, ReasonsInWords& result) {
  const std::string start = "not constrained: ";
  if (reason.compare(0, start.size(), start) != 0) return false;
  const std::string names = reason.substr(start.size(), reason.find(" (") - start.size());
  result.reasons.push_back("The surfaces that both sensors see do not constrain " + names + ".");
  for (const std::string& word : words_in(names)) {
    for (std::size_t i = 0; i < kDofNames.size(); ++i) {
      if (word == kDofNames[i]) add_once(result.advice, advice_for(static_cast<Dof>(i)));
    }
  }
  return true;
}

/// "the lead over a pose 3.0 m further along x, in standard deviations, is 1.200, below 4.000".
bool add_rival(const std::string& reason, ReasonsInWords& result) {
  const std::string start = "the lead over a pose ";
  const std::size_t end = reason.find(", in standard deviations");
  if (reason.compare(0, start.size(), start) != 0 || end == std::string::npos) return false;
  result.reasons.push_back(
      with_numbers("A pose " + reason.substr(start.size(), end - start.size()) +
                       " explains the clouds nearly as well: the lead over it is {1} standard "
                       "deviations; at least {2} are required.",
                   numbers_in(reason.substr(end))));
  add_once(result.advice, kOtherPlace);
  return true;
}

/// `text` as a sentence.
std::string sentence_of(std::string text) {
  if (text.empty()) return text;
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  if (text.back() != '.' && text.back() != '?') text += '.';
  return text;
}

/// The reason without a leading step name, which has no spaces.
std::string without_step(const std::string& reason) {
  const std::size_t colon = reason.find(": ");
  if (colon == std::string::npos || reason.find(' ') < colon) return reason;
  return reason.substr(colon + 2);
}

void add_reason(const std::string& whole, ReasonsInWords& result) {
  const std::string reason = without_step(whole);
  if (reason.empty() || add_unconstrained(reason, result) || add_rival(reason, result)) return;
  const auto* const found = std::find_if(std::begin(kTranslations), std::end(kTranslations),
                                         [&](const Translation& translation) {
                                           const std::string begins = translation.begins;
                                           return reason.compare(0, begins.size(), begins) == 0;
                                         });
  if (found == std::end(kTranslations)) {
    add_once(result.reasons, sentence_of(reason));
    return;
  }
  add_once(result.reasons, with_numbers(found->sentence, numbers_in(reason)));
  add_once(result.advice, found->advice);
}

}  // namespace

ReasonsInWords reasons_in_words(const std::string& rejection,
                                const std::optional<PoseCovariance>& covariance) {
  ReasonsInWords result;
  const std::string separator = "; ";
  for (std::size_t begin = 0; begin < rejection.size();) {
    const std::size_t end = std::min(rejection.find(separator, begin), rejection.size());
    add_reason(rejection.substr(begin, end - begin), result);
    begin = end + separator.size();
  }
  if (covariance) {
    for (std::size_t i = 0; i < 6; ++i) {
      if (covariance->dofs.at(i) != Observability::unobservable) continue;
      add_once(result.advice, advice_for(static_cast<Dof>(i)));
    }
  }
  return result;
}

}  // namespace croon

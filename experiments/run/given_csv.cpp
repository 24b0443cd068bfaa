#include "experiments/run/given_csv.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/data_path.hpp"
#include "framework/io/digest.hpp"
#include "framework/io/text_scan.hpp"

namespace croon::experiments {
namespace {

/// Reads the field of a line (RFC 4180) that begins at `at`, without its quotes, and moves `at`
/// behind it, to a comma or the end. A field has quotes at both ends or none.
std::string next_field(const std::string& line, std::size_t& at) {
  if (at >= line.size() || line[at] != '"') {
    const std::size_t end = std::min(line.find(',', at), line.size());
    std::string field = line.substr(at, end - at);
    if (field.find('"') != std::string::npos) refuse("no quote inside a field", in_quotes(field));
    at = end;
    return field;
  }
  std::string field;
  for (++at; at < line.size(); ++at) {
    if (line[at] == '"' && line.compare(at, 2, "\"\"") != 0) break;
    if (line[at] == '"') ++at;
    field += line[at];
  }
  if (at >= line.size()) refuse("a second quote", in_quotes(line));
  if (++at < line.size() && line[at] != ',') {
    refuse("a comma after a quoted field", in_quotes(line.substr(at)));
  }
  return field;
}

std::vector<std::string> fields_of(const std::string& line) {
  std::size_t at = 0;
  std::vector<std::string> fields = {next_field(line, at)};
  while (at < line.size()) fields.push_back(next_field(line, ++at));
  return fields;
}

/// Spreadsheets write this before the first line.
const std::string kByteOrderMark = "\xef\xbb\xbf";

std::string_view without_byte_order_mark(std::string_view bytes) {
  const std::size_t length = kByteOrderMark.size();
  return bytes.substr(0, length) == kByteOrderMark ? bytes.substr(length) : bytes;
}

/// `"a"`, or `"a" or "b"`.
std::string any_of(const std::vector<std::string>& headers) {
  std::string text;
  for (const std::string& header : headers)
    text += (text.empty() ? "\"" : " or \"") + header + "\"";
  return text;
}

/// A hint at the path below one of `folders` that is nearest to `name`; empty if none is near.
std::string nearest_of(const std::string& name, const std::vector<std::filesystem::path>& folders) {
  for (const std::filesystem::path& folder : folders) {
    const std::string hint = missing_path_hint(folder.empty() ? "." : folder, name);
    if (hint.rfind("; did you mean", 0) == 0) return hint;
  }
  return "";
}

}  // namespace

void refuse(const std::string& expected, const std::string& found) {
  throw InputError("", "", "expected " + expected + ", found " + found);
}

void require_fields(const CsvLine& line, std::size_t count) {
  if (line.fields.size() == count) return;
  refuse(std::to_string(count) + " fields", std::to_string(line.fields.size()));
}

bool begins_with_header(const std::filesystem::path& path, const std::string& header) {
  return file_begins_with(path, header) || file_begins_with(path, kByteOrderMark + header);
}

double bounded_number(const std::string& text, double max_size, const std::string& unit) {
  const double number = finite_number(text);
  if (std::abs(number) <= max_size) return number;
  const std::string bound = fixed_number(max_size, 0);
  refuse("a number from -" + bound + " to " + bound + " " + unit, in_quotes(text));
}

double finite_number(const std::string& text) {
  const std::optional<double> number = number_from(text);
  if (!number) refuse("a number", in_quotes(text));
  if (!std::isfinite(*number)) refuse("a finite number", in_quotes(text));
  return *number;
}

std::string read_given_csv(const std::filesystem::path& path,
                           const std::vector<std::string>& headers,
                           const std::function<void(const CsvLine&)>& add) {
  const std::string bytes = read_whole_file(path);
  const std::string file = path.string();
  LineReader reader(without_byte_order_mark(bytes));
  if (!reader.next() || std::find(headers.begin(), headers.end(), reader.line()) == headers.end()) {
    throw InputError(file, "line 1",
                     "expected " + any_of(headers) + ", found " + in_quotes(reader.line()));
  }
  CsvLine line;
  line.header = reader.line();
  std::vector<Fault> faults;
  std::size_t more = 0;
  while (reader.next()) {
    line.is_shown = faults.size() < kShownFaults;
    try {
      line.fields = fields_of(std::string(reader.line()));
      add(line);
    } catch (const InputError& error) {
      if (line.is_shown) faults.push_back({file, reader.place(), error.faults().front().message});
      if (!line.is_shown) ++more;
    }
  }
  if (!faults.empty()) throw_first(std::move(faults), file, more);
  return sha256_of_text(bytes);
}

void throw_first(std::vector<Fault> faults, const std::string& file, std::size_t more) {
  if (faults.size() > kShownFaults) {
    more += faults.size() - kShownFaults;
    faults.resize(kShownFaults);
  }
  if (more > 0) faults.push_back({file, "", "and " + std::to_string(more) + " more faults"});
  throw InputError(std::move(faults));
}

std::filesystem::path found_input(const Experiment& experiment, const std::string& name,
                                  const std::filesystem::path& data_root, const Fault& at,
                                  const std::string& what) {
  namespace fs = std::filesystem;
  const fs::path beside = fs::path(experiment.file).parent_path();
  std::string found;
  for (const fs::path& folder : {data_root, beside.empty() ? fs::path(".") : beside}) {
    const fs::path path = folder / name;
    std::error_code error;
    const fs::path whole_folder = fs::canonical(folder, error);
    if (error) continue;
    if (!fs::is_regular_file(path, error)) {
      if (fs::exists(path, error)) found = found_instead_of_file(path) + " at " + path.string();
      continue;
    }
    const fs::path whole_path = fs::canonical(path, error);
    if (!error && is_within(whole_path, whole_folder)) return path;
    found = path.string() + ", which is outside the folder " + folder.string();
  }
  if (found.empty()) {
    const std::string first = (data_root / name).string(), second = (beside / name).string();
    found = first == second ? "no " + first : "neither " + first + " nor " + second;
    found += nearest_of(name, {data_root, beside});
  }
  throw InputError(at.file, at.where, "expected " + what + ", found " + found);
}

}  // namespace croon::experiments

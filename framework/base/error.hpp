#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace croon {

/// One mistake in the caller's input: the file, the position in it (a JSON pointer, a line or a
/// byte; may be empty), and one sentence with what was expected and what was found.
struct Fault {
  std::string file;
  std::string where;
  std::string message;
  /// For a rule over several values: the JSON pointers of all values that break it together.
  std::vector<std::string> parts = {};

  /// The fault as one line for the user, `file: where: message`: printable, and cut if it is long.
  std::string line() const;
};

/// The caller's input is wrong. Contains all faults that were found, not only the first. The
/// program exits with 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Fault> faults);
  InputError(std::string file, std::string where, std::string message);

  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// Calls `work`. If it throws an InputError, appends its faults to `faults`.
void collect_faults(std::vector<Fault>& faults, const std::function<void()>& work);

/// Appends `note` to `notes` unless they contain its message.
void add_note(std::vector<Fault>& notes, const Fault& note);

/// `faults` without those whose line already occurred.
std::vector<Fault> without_repeats(const std::vector<Fault>& faults);

/// The data defeated a stage (no ground, too few correspondences, ...). The trial is recorded as
/// `failed` with this reason and the run continues.
class StageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns what `work` returns. An exception of type `Error`, with which the library called
/// `library` reports that it cannot handle the data, becomes a StageError.
///
/// Only a StageError ends a trial without ending the run; any other exception is a bug or a failure
/// of the machine. So a stage wraps its calls of a library in this function if, and only if, the
/// library throws for valid calls with unusual data:
///
/// | exception | converted | reason |
/// |---|---|---|
/// | CGAL::Failure_exception | yes | a precondition or assertion fails on degenerate points |
/// | openvdb::Exception | no | thrown for trees of another type or origin: a wrong call |
/// | tbb::bad_last_alloc, std::system_error | no | the machine has no memory or threads left |
/// | std::bad_alloc | no | depends on the machine and the moment, so it must not become a result |
///
/// Eigen and LZF throw no exceptions of their own.
template <class Error, class Work>
auto with_stage_errors(const std::string& library, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw StageError(library + ": " + error.what());
  }
}

/// The known name with the minimum edit distance to `name`. Empty if even that name is too
/// different: in more than half of the characters of a long `name`, or in all of a short one.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

/// `; did you mean "ransac"?`, or `; known: a, b, c` if no known name is near. Empty if `known` is
/// empty.
std::string name_hint(const std::string& name, const std::vector<std::string>& known);

}  // namespace croon

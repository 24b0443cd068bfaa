#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace croon {

/// One mistake in the caller's input: the file, the position in it (a JSON pointer, a line or a
/// byte; empty if there is none), and one sentence with what was expected and what was found.
struct Fault {
  std::string file;
  std::string where;
  std::string message;
  /// Of a rule over several values: the JSON pointers of those that break it together.
  std::vector<std::string> parts = {};

  /// The fault as one line for the user, `file: where: message`: printable, and cut if it is long.
  std::string line() const;
};

/// The caller's input is wrong. Holds all faults that were found, not only the first. The program
/// exits with 2.
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

/// `faults` without those whose line occurs earlier in the list.
std::vector<Fault> without_repeats(const std::vector<Fault>& faults);

/// The data defeated a stage (no ground, too few correspondences, ...). The trial is recorded as
/// `failed` with this reason and the run goes on.
class StageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns what `work` returns. An exception of the type `Error`, by which the library called
/// `library` says that it cannot handle the data, becomes a StageError.
///
/// A StageError is the only exception that ends a trial alone; any other one ends the run, because
/// it is a bug or a failure of the machine. So a stage wraps its calls of a library in this
/// function if, and only if, the library throws at valid calls with unusual data:
///
/// | exception | converted | reason |
/// |---|---|---|
/// | CGAL::Failure_exception | yes | a precondition or assertion fails on degenerate points |
/// | openvdb::Exception | no | thrown at trees of another type or origin: a wrong call |
/// | tbb::bad_last_alloc, std::system_error | no | the machine has no memory or threads left |
/// | std::bad_alloc | no | of this machine at this time, so it must not become a result |
///
/// Eigen and LZF throw nothing of their own.
template <class Error, class Work>
auto with_stage_errors(const std::string& library, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw StageError(library + ": " + error.what());
  }
}

/// The known name with the smallest edit distance to `name`. Empty if the nearest one is too far:
/// the whole of a short name or more than half of a long one differs.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

/// `; did you mean "ransac"?`, or `; known: a, b, c` if no known name is near. Empty if `known` is
/// empty.
std::string name_hint(const std::string& name, const std::vector<std::string>& known);

}  // namespace croon

#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace croon {

/// One thing that is wrong with what the caller gave: the file, the place in it (a JSON pointer, a
/// line or a byte; empty where there is none) and one sentence: what was expected and what was
/// found.
struct Fault {
  std::string file;
  std::string where;
  std::string message;

  /// The fault as the one line that the user reads: `file: where: message`.
  std::string line() const;
};

/// The caller's mistake: all faults that were found, not the first alone. The program exits with 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Fault> faults);
  InputError(std::string file, std::string where, std::string message);

  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// Does `work` and notes in `faults` those of the InputError that it throws.
void collect_faults(std::vector<Fault>& faults, const std::function<void()>& work);

/// `faults` with each line once, in order.
std::vector<Fault> without_repeats(const std::vector<Fault>& faults);

/// The data defeated a stage (no ground, too few correspondences, ...). The trial is recorded as
/// `failed` with this reason and the run goes on.
class StageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace croon

#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "framework/stage/catalogue.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the namespace of CLI11.
class App;
}

namespace croon::experiments {

/// The environment of a command.
struct Console {
  const Catalogue& catalogue;
  std::ostream& out;  ///< The answer.
  std::ostream& err;  ///< Progress, warnings and errors.
  bool colours;       ///< Whether the answer may have colours.
};

/// A command of the program: its options and what it does. The file NAME_command.cpp of this folder
/// defines it and `make_NAME_command`; CMake lists the files.
class Command {
 public:
  virtual ~Command() = default;
  /// One sentence for the help.
  virtual std::string sentence() const = 0;
  virtual void add_options(CLI::App& command) = 0;
  /// Returns the exit code: 0, or 3 if the command finished but something in it failed. Throws
  /// InputError, before anything is written, if the request is wrong.
  virtual int run(const Console& console) = 0;
};

struct NamedCommand {
  std::string name;
  std::unique_ptr<Command> command;
};

/// All commands, by name.
std::vector<NamedCommand> all_commands();

}  // namespace croon::experiments

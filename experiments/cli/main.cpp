// The program: runs the command. Only this file reads the command line.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>

#include "experiments/cli/command.hpp"
#include "experiments/cli/commands.hpp"
#include "experiments/store/version.hpp"
#include "framework/base/error.hpp"
#include "framework/base/huge_pages.hpp"
#include "framework/base/memory.hpp"
#include "framework/base/text.hpp"
#include "registry/registry.hpp"

namespace croon::experiments {
namespace {

constexpr int kRequestIsWrong = 2;

/// The command line.
class Program {
 public:
  Program()
      : app_("Calibrates the LiDARs of a vehicle to each other and compares calibration methods.",
             "croon"),
        commands_(all_commands()) {
    app_.set_version_flag("--version", std::string("croon ") + croon_version());
    app_.allow_extras();
    for (const NamedCommand& named : commands_) {
      named.command->add_options(*app_.add_subcommand(named.name, named.command->sentence()));
    }
  }

  /// Throws InputError if the command line is wrong.
  int run(int argc, char** argv) {
    try {
      app_.parse(argc, argv);
    } catch (const CLI::Success& success) {
      return app_.exit(success, std::cout, std::cout);
    } catch (const CLI::RequiredError& error) {
      throw InputError("", "", error.what() + long_list());
    } catch (const CLI::ParseError& error) {
      throw InputError("", "", error.what());
    }
    refuse_leftovers();
    const std::vector<CLI::App*> given = app_.get_subcommands();
    if (given.empty()) {
      std::cout << app_.help();
      return 0;
    }
    const auto named = std::find_if(
        commands_.begin(), commands_.end(),
        [&](const NamedCommand& command) { return command.name == given.front()->get_name(); });
    return named->command->run({registry(), std::cout, std::cerr, ::isatty(STDOUT_FILENO) != 0});
  }

 private:
  /// Throws InputError for words that no option or command consumed.
  void refuse_leftovers() const {
    const std::vector<CLI::App*> commands = app_.get_subcommands();
    const CLI::App& command = commands.empty() ? app_ : *commands.front();
    for (const std::string& word : app_.remaining(true)) {
      if (word.compare(0, 1, "-") == 0) refuse_option(word.substr(0, word.find('=')), command);
      if (!commands.empty()) throw InputError("", "", "unexpected \"" + word + "\"");
      std::vector<std::string> names;
      for (const CLI::App* known : app_.get_subcommands({})) names.push_back(known->get_name());
      throw InputError("", "", "unknown command \"" + word + "\"" + name_hint(word, names));
    }
  }

  [[noreturn]] static void refuse_option(const std::string& name, const CLI::App& command) {
    const std::vector<std::string> known = options_of(command);
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InputError("", "", "unknown option \"" + name + "\"" + name_hint(name, known));
    }
    throw InputError("", "",
                     "expected the option \"" + name + "\" after the command, found it before \"" +
                         command.get_name() + "\"");
  }

  /// A hint if an option consumed several words: the missing argument may be one of them.
  std::string long_list() const {
    for (const CLI::App* command : app_.get_subcommands()) {
      for (const CLI::Option* option : command->get_options()) {
        if (option->get_positional() || option->count() < 2) continue;
        return "; " + option->get_name() + " consumed \"" + option->results().back() +
               "\": required arguments must precede " + option->get_name();
      }
    }
    return "";
  }

  static std::vector<std::string> options_of(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
  }

  CLI::App app_;
  std::vector<NamedCommand> commands_;
};

/// Throws InputError if the output cannot be written: the disk is full or the pipe closed.
int run_and_flush(int argc, char** argv) {
  const int code = Program().run(argc, argv);
  if (!std::cout.flush()) throw InputError("", "standard output", "cannot be written");
  return code;
}

int croon_main(int argc, char** argv) {
  try {
    return run_and_flush(argc, argv);
  } catch (const InputError& error) {
    print_faults(error, std::cerr);
  } catch (const std::filesystem::filesystem_error& error) {
    print_faults(InputError(error.path1().string(), "", error.code().message()), std::cerr);
  }
  return kRequestIsWrong;
}

}  // namespace
}  // namespace croon::experiments

int main(int argc, char** argv) {
  // Exceeding the shell's limit of file size is then an error like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  // With less, the memory allocator crashes when it starts a thread.
  constexpr double kMinAddressSpace_bytes = 128e6;
  if (croon::address_space_bytes() < kMinAddressSpace_bytes) {
    std::cerr << "croon: needs at least 128 MB of address space; see ulimit -v\n";
    return 1;
  }
  try {
    return croon::experiments::croon_main(argc, argv);
  } catch (const std::bad_alloc&) {
    std::cerr << "croon: there is not enough memory; finished trials are in the store\n";
    return 1;
  } catch (const std::runtime_error& error) {
    // Errors of the standard library or TBB if the machine runs out of memory or threads.
    std::cerr << "croon: " << croon::printable(error.what())
              << "; finished trials are in the store\n";
    return 1;
  } catch (const std::exception& error) {
    std::cerr << "croon: this is a bug: " << croon::printable(error.what()) << "\n";
    return 1;
  }
}

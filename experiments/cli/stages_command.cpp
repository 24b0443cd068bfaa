#include <memory>

#include "experiments/cli/command.hpp"
#include "experiments/cli/options.hpp"
#include "registry/help.hpp"

namespace croon::experiments {
namespace {

class StagesCommand final : public Command {
 public:
  std::string sentence() const override { return "List the stages."; }

  void add_options(CLI::App& command) override {
    add_text(command, "KIND/NAME", stage_, "A kind of stage, or one stage with its parameters.",
             "a kind of stage");
    CLI::Option* const json = command.add_flag("--json", is_json_, "As JSON.");
    command.add_flag("--markdown", is_markdown_, "As Markdown.")->excludes(json);
  }

  int run(const Console& console) override {
    console.out << stages_help(console.catalogue, stage_,
                               is_markdown_ ? HelpFormat::markdown
                               : is_json_   ? HelpFormat::json
                                            : HelpFormat::text);
    return 0;
  }

 private:
  std::string stage_;
  bool is_json_ = false;
  bool is_markdown_ = false;
};

}  // namespace

std::unique_ptr<Command> make_stages_command() { return std::make_unique<StagesCommand>(); }

}  // namespace croon::experiments

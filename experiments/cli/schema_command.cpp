#include <memory>

#include "experiments/cli/command.hpp"
#include "experiments/file/experiment.hpp"

namespace croon::experiments {
namespace {

class SchemaCommand final : public Command {
 public:
  std::string sentence() const override { return "Print the JSON Schema of experiment files."; }
  void add_options(CLI::App&) override {}
  int run(const Console& console) override {
    console.out << experiment_schema(console.catalogue);
    return 0;
  }
};

}  // namespace

std::unique_ptr<Command> make_schema_command() { return std::make_unique<SchemaCommand>(); }

}  // namespace croon::experiments

// What the pages show works: every command of a `sh` block is run here, page by page in a folder of
// its own that looks like the checkout, with `croon` on the path. Two marks after `sh` say
// otherwise: `setup` for what needs the network, root or minutes, which .ci/run runs instead, and
// `samples` for what needs the authors' recordings.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "experiments/file/experiment.hpp"
#include "framework/base/error.hpp"
#include "registry/registry.hpp"
#include "test/house/fenced_block.hpp"
#include "test/support/data_root.hpp"
#include "test/support/script.hpp"
#include "test/support/temp_folder.hpp"
#include "test/support/tree.hpp"

namespace croon::test {
namespace {

namespace fs = std::filesystem;

/// What `setup` blocks may hold.
const std::set<std::string> kSetUpCommands = {
    "make demo",
    "make test",
    "make docs",
    "make site",
    "cmake --preset no_cgal && cmake --build --preset no_cgal",
};

/// Makes `folder` look like the checkout to what runs in it.
void link_tree(const fs::path& folder) {
  for (const char* linked : {"docs", "experiments"}) {
    fs::create_directory_symlink(source_root() / linked, folder / linked);
  }
}

/// The page's name as a word: "docs_tutorial_md".
std::string page_name(const testing::TestParamInfo<std::string>& info) {
  return std::regex_replace(info.param, std::regex("[^A-Za-z0-9]"), "_");
}

class Docs : public testing::TestWithParam<std::string> {};

TEST_P(Docs, CommandsWork) {
  std::string script;
  bool wants_samples = false;
  for (const FencedBlock& block : fenced_blocks(GetParam(), "sh")) {
    if (block.mark == "setup") continue;
    EXPECT_TRUE(block.mark.empty() || block.mark == "samples") << block.place();
    wants_samples = wants_samples || block.mark == "samples";
    if (block.mark == "samples" && data_root().empty()) continue;
    script += block.text();
  }
  if (script.empty() && wants_samples) GTEST_SKIP() << "the authors' samples are not here";
  const TempFolder folder;
  link_tree(folder.path());
  const Finished finished = run_script(script, folder.path());
  EXPECT_EQ(finished.status, 0) << script << "\n--- gave\n" << finished.output;
}

TEST_P(Docs, SetUpCommandsAreRunByTheContinuousIntegration) {
  std::ostringstream run;
  run << std::ifstream(source_root() / ".ci" / "run").rdbuf();
  for (const FencedBlock& block : fenced_blocks(GetParam(), "sh")) {
    if (block.mark != "setup") continue;
    for (const std::string& command : block.lines) {
      EXPECT_EQ(kSetUpCommands.count(command), 1U) << block.place() << ": " << command;
      EXPECT_NE(run.str().find(command), std::string::npos)
          << block.place() << ": .ci/run does not run " << command;
    }
  }
}

TEST_P(Docs, ExperimentsAreValid) {
  const TempFolder folder;
  link_tree(folder.path());
  for (const FencedBlock& block : fenced_blocks(GetParam(), "json")) {
    const bool is_experiment = block.text().find("\"pipeline\"") != std::string::npos ||
                               block.text().find("\"extends\"") != std::string::npos;
    if (!is_experiment) continue;
    const fs::path file = folder.write("experiment.json", block.text());
    EXPECT_NO_THROW(experiments::load_experiment(file, registry())) << block.place();
  }
}

/// Links to files of the tree, `[words](path)` or `[words](path#place)`, lead somewhere.
void expect_working_links(const std::string& page) {
  static const std::regex link(R"(\]\(([^)#:]+)(#[^)]*)?\))");
  const fs::path folder = (source_root() / page).parent_path();
  for (const Line& line : lines_of(page)) {
    for (auto it = std::sregex_iterator(line.text.begin(), line.text.end(), link);
         it != std::sregex_iterator(); ++it) {
      EXPECT_TRUE(fs::exists(folder / (*it)[1].str())) << line.place() << ": " << (*it)[1];
    }
  }
}

TEST_P(Docs, LinksLeadSomewhere) { expect_working_links(GetParam()); }

/// Pages of the notebook keep the commands of their date, so only their links are checked.
TEST(Notebook, LinksLeadSomewhere) {
  for (const std::string& page : tree_files("docs/notebook/", ".md")) expect_working_links(page);
}

/// A path of the tree in backquotes, `framework/base/rng.hpp`, is there.
TEST_P(Docs, NamedFilesExist) {
  static const std::regex path(
      R"(`((framework|stages|registry|experiments|benchmarks|test|docs|cmake|\.ci)/[\w./]+)`)");
  for (const Line& line : lines_of(GetParam())) {
    for (auto it = std::sregex_iterator(line.text.begin(), line.text.end(), path);
         it != std::sregex_iterator(); ++it) {
      EXPECT_TRUE(fs::exists(source_root() / (*it)[1].str())) << line.place() << ": " << (*it)[1];
    }
  }
}

/// This build has the stages of the examples, which are not of the tree.
TEST(GenerateDocs, RefusesAProgramWithOtherStagesThanTheTree) {
  const TempFolder folder;
  const std::string script = (source_root() / ".ci" / "generate_docs").string();
  const Finished finished =
      run_script("\"" + script + "\" \"$(command -v croon)\" pages || echo code $?", folder.path());
  EXPECT_EQ(finished.status, 0);
  for (const char* part :
       {"expected the stages of this tree, found also", " step/overlap_alignment", "\ncode 2\n"}) {
    EXPECT_NE(finished.output.find(part), std::string::npos) << finished.output;
  }
  EXPECT_FALSE(fs::exists(folder.path() / "pages"));
}

/// The example in docs/extending.md is the one that is built.
TEST(ExampleStage, StandsInThePage) {
  std::string sources;
  for (const char* ending : {".cpp", ".hpp", ".txt"}) {
    for (const std::string& file : tree_files("docs/example_stage/", ending)) {
      for (const Line& line : lines_of(file)) sources += line.text + "\n";
    }
  }
  for (const char* language : {"cpp", "cmake"}) {
    const std::vector<FencedBlock> blocks = fenced_blocks("docs/extending.md", language);
    EXPECT_FALSE(blocks.empty()) << language;
    for (const FencedBlock& block : blocks) {
      EXPECT_NE(sources.find(block.text()), std::string::npos) << block.place();
    }
  }
  EXPECT_NE(registry().find("step", "overlap_alignment"), nullptr);
}

/// A test of test/library builds the example in docs/library.md.
TEST(ExamplePaper, StandsInThePage) {
  std::string text;
  for (const Line& line : lines_of("docs/example_paper/CMakeLists.txt")) text += line.text + "\n";
  EXPECT_EQ(fenced_blocks("docs/library.md", "cmake").back().text(), text);
}

/// What docs/paper/paper.md says in bold stands in docs/results.md, line breaks aside.
TEST(SoftwarePaper, QuotesTheResults) {
  std::string paper, results;
  for (const Line& line : lines_of("docs/paper/paper.md")) paper += line.text + " ";
  for (const Line& line : lines_of("docs/results.md")) results += line.text + " ";
  static const std::regex bold(R"(\*\*([^*]+)\*\*)");
  const std::sregex_iterator first(paper.begin(), paper.end(), bold);
  EXPECT_GT(std::distance(first, std::sregex_iterator()), 10);
  for (auto it = first; it != std::sregex_iterator(); ++it) {
    EXPECT_NE(results.find((*it)[1]), std::string::npos) << (*it)[1];
  }
}

INSTANTIATE_TEST_SUITE_P(Pages, Docs, testing::ValuesIn(written_pages()), page_name);

}  // namespace
}  // namespace croon::test

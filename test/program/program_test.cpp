#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <set>
#include <sstream>
#include <string>

#include "experiments/cli/commands.hpp"
#include "experiments/file/experiment.hpp"
#include "registry/registry.hpp"
#include "test/program/program.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

TEST(Program, AnswersAWrongCommandLineWithOneLine) {
  const auto expect_line = [](const std::string& arguments, const std::string& line) {
    const Answer answer = croon(arguments);
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_EQ(answer.text, line + "\n");
  };
  expect_line("rnu x.json", "croon: unknown command \"rnu\"; did you mean \"run\"?");
  expect_line("run x.json --jbos 2", "croon: unknown option \"--jbos\"; did you mean \"--jobs\"?");
  expect_line("--versoin", "croon: unknown option \"--versoin\"; did you mean \"--version\"?");
  expect_line("--quiet run x.json",
              "croon: expected the option \"--quiet\" after the command, found it before \"run\"");
  expect_line("--out=o run x.json",
              "croon: expected the option \"--out\" after the command, found it before \"run\"");
  expect_line("run --only base x.json --plan",
              "croon: EXPERIMENT is required; --only consumed \"x.json\": required arguments must "
              "precede --only");
  expect_line("validate none.json", "croon: none.json: expected a readable file, found none");
  for (const char* arguments :
       {"run", "run x.json --jobs two", "run x.json --jobs 0", "run x.json --trials -1",
        "run x.json --jobs 1025", "run x.json --shard", "stages --json --markdown", "schema more",
        "stages no_such_kind", "run x.json y.json"}) {
    const Answer answer = croon(arguments);
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_EQ(answer.text.rfind("croon: ", 0), 0U) << answer.text;
    EXPECT_EQ(answer.text.find('\n') + 1, answer.text.size()) << answer.text;
  }
}

TEST(Program, TakesNoEmptyTextForADefault) {
  for (const char* option : {"--figure", "--format", "--units", "--width", "--out"}) {
    const Answer answer = croon(std::string("export results ") + option + " ''");
    EXPECT_EQ(answer.code, 2) << option;
    EXPECT_EQ(answer.text.rfind(std::string("croon: ") + option + ": expected ", 0), 0U)
        << answer.text;
  }
}

TEST(Program, TakesNoOptionForTheValueOfAnother) {
  const test::TempFolder folder;
  folder.write("x.json", R"({"name": "x", "dataset": {"type": "simulated", "scenes": 1},
                             "pipeline": [{"step": "identity"}]})");
  const std::string run = "run " + (folder.path() / "x.json").string();
  const auto expect_line = [](const std::string& arguments, const std::string& line) {
    const Answer answer = croon(arguments);
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_EQ(answer.text, "croon: " + line + "\n");
  };
  for (const char* option : {"--out", "--data"}) {
    expect_line(run + " " + option + " --fresh",
                std::string(option) + ": expected a path, found the option \"--fresh\"");
  }
  expect_line(run + " --only --fresh", "--only: expected a variant, found the option \"--fresh\"");
  expect_line("export results --columns --compact",
              "--columns: expected a column, found the option \"--compact\"");
}

TEST(Program, SaysHowManyTrialsThereMayBe) {
  for (const char* trials : {"1000001", "99999999999", "1e3", "two", "0"}) {
    const Answer answer = croon(std::string("run x.json --trials ") + trials);
    EXPECT_EQ(answer.code, 2);
    EXPECT_EQ(answer.text,
              std::string("croon: --trials: expected a whole number from 1 to 1000000, found ") +
                  trials + "\n");
  }
}

TEST(Program, TakesNoEmptyTextForAPath) {
  const auto expect_line = [](const std::string& arguments, const std::string& line) {
    const Answer answer = croon(arguments);
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_EQ(answer.text, "croon: " + line + ", found \"\"\n") << arguments;
  };
  for (const char* command : {"run ''", "simulate '' --out o", "describe ''", "starts ''"}) {
    expect_line(command, "EXPERIMENT: expected a path");
  }
  for (const char* command : {"export ''", "export results ''", "merge '' --out o", "claims ''"}) {
    expect_line(command, "DIR: expected a path");
  }
  expect_line("validate ''", "PATH: expected a path");
  expect_line("stages ''", "KIND/NAME: expected a kind of stage");
}

TEST(Program, ValidatesFilesAndFolders) {
  const test::TempFolder folder;
  const std::string path = folder.path().string();
  folder.write("good.json", R"({"name": "x", "dataset": {"type": "opencalib", "path": "nowhere"},
                                "pipeline": [{"step": "identity"}]})");
  EXPECT_EQ(croon("validate " + path).text, path + "/good.json: ok\n");
  EXPECT_EQ(croon("validate " + path).code, 0);
  folder.write("bad.json", R"({"name": "x", "dataset": {"type": "opencalib", "path": "nowhere"},
                               "pipeline": [{"step": "identiy"}], "seed": -1})");
  const Answer answer = croon("validate " + path);
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find(path + "/good.json: ok\n"), std::string::npos);
  EXPECT_NE(answer.text.find("croon: " + path + "/bad.json: /seed: expected"), std::string::npos);
  EXPECT_NE(answer.text.find("croon: " + path +
                             "/bad.json: /pipeline/0/step: expected a step, found "
                             "\"identiy\"; did you mean \"identity\"?\n"),
            std::string::npos);
}

/// This process without the rights of root, to which no folder is closed.
class WithoutRights {
 public:
  WithoutRights() : user_(::geteuid()) {
    if (user_ == 0) {
      EXPECT_EQ(::seteuid(65534), 0);
    }
  }
  ~WithoutRights() {
    if (user_ == 0) {
      EXPECT_EQ(::seteuid(user_), 0);
    }
  }
  WithoutRights(const WithoutRights&) = delete;
  WithoutRights& operator=(const WithoutRights&) = delete;

 private:
  ::uid_t user_;
};

TEST(Program, ValidatesBesideFoldersThatItCannotRead) {
  const test::TempFolder folder;
  const fs::path root = folder.path();
  for (const char* name : {"a/x.json", "closed/x.json", "shut/x.json", "z/x.json"}) {
    folder.write(name, R"({"name": "x", "dataset": {"type": "opencalib", "path": "nowhere"},
                           "pipeline": [{"step": "identity"}]})");
  }
  fs::permissions(root, fs::perms::all);
  for (const char* name : {"closed", "shut"}) fs::permissions(root / name, fs::perms::none);
  std::ostringstream out, err;
  {
    const WithoutRights without;
    EXPECT_EQ(validate_command({root}, registry(), out, err), 2);
  }
  for (const char* name : {"closed", "shut"}) {
    fs::permissions(root / name, fs::perms::all);
    EXPECT_NE(err.str().find("croon: " + (root / name).string() +
                             ": cannot be read: Permission denied\n"),
              std::string::npos)
        << err.str();
  }
  EXPECT_EQ(out.str(),
            (root / "a/x.json").string() + ": ok\n" + (root / "z/x.json").string() + ": ok\n");
}

TEST(Program, ValidatesBesideFoldersWithoutExperiments) {
  const test::TempFolder folder;
  folder.write("a/x.json", R"({"name": "x", "dataset": {"type": "opencalib", "path": "nowhere"},
                               "pipeline": [{"step": "identity"}]})");
  fs::create_directory(folder.path() / "empty");
  const std::string root = folder.path().string();
  const Answer answer = croon("validate " + root + "/empty " + root + "/a");
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(answer.text, "croon: " + root + "/empty: expected a folder with *.json files\n" + root +
                             "/a/x.json: ok\n");
}

TEST(Program, GivesEachPointOfAGridANameOfItsOwn) {
  const test::TempFolder folder;
  const fs::path file = folder.write("x.json", R"-({"name": "x", "dataset": {"type": "simulated"},
          "pipeline": [{"step": "known_velocity"}],
          "grid": {"known_velocity.file": ["a_b (3)", "a/b", "a_b", "a,b", "a_b (4)"]}})-");
  std::set<std::string> names;
  for (const Variant& variant : load_experiment(file, registry()).variants) {
    names.insert(variant.name);
  }
  EXPECT_EQ(names.size(), 5U);
}

TEST(Program, WarnsOncePerFormerNameOfAKey) {
  const test::TempFolder folder;
  const std::string file = folder
                               .write("x.json", R"({"name": "x", "starts": {"trials": 1},
      "dataset": {"type": "simulated", "scenes": 1, "rig": {"sensors": {
        "top": {"model": {"like": "spinner_16", "range_max_m": 50, "azimuth_step_deg": 2}},
        "left": {"model": {"like": "spinner_16", "range_max_m": 50, "azimuth_step_deg": 2}}}}},
      "pipeline": [{"step": "consensus", "rotation_deg": 1}],
      "variants": [{"name": "v", "replace": {"consensus.rotation_deg": 2}}]})")
                               .string();
  const std::string warnings = "croon: warning: " + file +
                               ": /dataset/rig/sensors/left/model/range_max_m: the key "
                               "\"range_max_m\" is now called \"max_range_m\"\n"
                               "croon: warning: " +
                               file +
                               ": /pipeline/0/rotation_deg: the key \"rotation_deg\" is now called "
                               "\"max_rotation_deg\"\n";
  for (const std::string& command :
       {"validate " + file, "run " + file + " --plan --out " + folder.path().string() + "/out"}) {
    const Answer answer = croon(command);
    EXPECT_EQ(answer.code, 0);
    EXPECT_EQ(answer.text.rfind(warnings, 0), 0U) << answer.text;
    EXPECT_EQ(answer.text.find("warning", warnings.size()), std::string::npos) << answer.text;
  }
}

TEST(Program, RefusesWhatCanOnlyFailWhenItValidates) {
  const test::TempFolder folder;
  const auto validate = [&](const std::string& members) {
    const std::string file =
        folder
            .write("x.json", R"({"name": "x", "dataset": {"type": "simulated"}, )" + members + "}")
            .string();
    const Answer answer = croon("validate " + file);
    return answer.code == 2 ? answer.text.substr(std::string("croon: " + file + ": ").size())
                            : answer.text;
  };
  EXPECT_EQ(validate(R"("pipeline": [{"step": "consensus", "weights": "covariance"}])"),
            "/pipeline/0: the step \"consensus\" needs the extra \"covariance\" (the covariance of "
            "the pose), which no earlier step provides, in variant \"base\"\n");
  for (const char* before : {"covariance", "bundle_adjustment"}) {
    const std::string steps = std::string(R"({"step": ")") + before +
                              R"("}, {"step": "consensus", "weights": "covariance"})";
    EXPECT_EQ(validate(R"("pipeline": [)" + steps + "]"), folder.path().string() + "/x.json: ok\n");
  }
  EXPECT_EQ(
      validate(R"("loops": true, "pipeline": [{"step": "identity"}], "variants": [{"name": "v",
                        "replace": {"identity": {"step": "known_velocity"}}}])"),
      "/variants/0/replace/identity: the step \"identity\" cannot be used with \"loops\": the "
      "velocity is that of the reference, not of other targets\n");
  EXPECT_EQ(validate(R"("pipeline": [{"step": "identity", "name": "-x"}])"),
            "/pipeline/0/name: expected a name of letters, digits, _ and -, not starting with -, "
            "found \"-x\"\n");
}

TEST(Program, TellsItsVersionStagesAndSchema) {
  EXPECT_EQ(croon("--version").text.rfind("croon ", 0), 0U);
  EXPECT_EQ(croon("--version").code, 0);
  EXPECT_NE(croon("stages").text.find("yaw_alignment"), std::string::npos);
  EXPECT_NE(croon("stages step/yaw_alignment").text.find("max_points"), std::string::npos);
  EXPECT_NE(croon("stages --json").text.find("\"yaw_alignment\""), std::string::npos);
  EXPECT_NE(croon("schema").text.find("\"$schema\""), std::string::npos);
  EXPECT_EQ(croon("--help").code, 0);
}

}  // namespace
}  // namespace croon::experiments

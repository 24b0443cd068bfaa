#include <gtest/gtest.h>

#include <string>

#include "test/program/program.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

TEST(Program, AnswersAWrongCommandLineWithOneLine) {
  const auto expect_line = [](const std::string& arguments, const std::string& line) {
    const Answer answer = croon(arguments);
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_EQ(answer.text, line + "\n");
  };
  expect_line("rnu x.json", "croon: unknown command \"rnu\"; did you mean \"run\"?");
  expect_line("run x.json --jbos 2", "croon: unknown option \"--jbos\"; did you mean \"--jobs\"?");
  expect_line("--versoin", "croon: unknown option \"--versoin\"; did you mean \"--version\"?");
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
            "the pose), which no step before it gives, in variant \"base\"\n");
  for (const char* before : {"covariance", "bundle_adjustment"}) {
    const std::string steps = std::string(R"({"step": ")") + before +
                              R"("}, {"step": "consensus", "weights": "covariance"})";
    EXPECT_EQ(validate(R"("pipeline": [)" + steps + "]"), folder.path().string() + "/x.json: ok\n");
  }
  EXPECT_EQ(
      validate(R"("loops": true, "pipeline": [{"step": "identity"}], "variants": [{"name": "v",
                        "replace": {"identity": {"step": "known_velocity"}}}])"),
      "/variants/0/replace/identity: the step \"identity\" expects no \"loops\": the velocity "
      "is that of the reference, and pairs have another\n");
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

// Whether LaTeX takes what is exported, where it is installed.
#include <gtest/gtest.h>

#include <cstdlib>

#include "experiments/report/export_choice.hpp"
#include "experiments/report/plots.hpp"
#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/picture/writers.hpp"
#include "test/support/temp_folder.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

constexpr const char* kHead =
    "\\documentclass[a4paper,twocolumn]{article}\n"
    "\\usepackage[a4paper,margin=17mm]{geometry}\n"
    "\\usepackage{booktabs,etoolbox}\n";

bool runs(const std::string& command) {
  return std::system((command + " > /dev/null 2>&1").c_str()) == 0;
}

bool has_latex() {
  return runs("pdflatex --version") && runs("kpsewhich siunitx.sty") &&
         runs("kpsewhich booktabs.sty") && runs("kpsewhich etoolbox.sty");
}

/// The log of a document with `content` as the file table.tex; ends with "failed" where there is no
/// PDF.
std::string log_of(const std::string& content, const std::string& packages) {
  const croon::test::TempFolder folder;
  folder.write("table.tex", content);
  folder.write("paper.tex", kHead + packages +
                                "\\begin{document}\nText.\n\\input{table}\n"
                                "Table~\\ref{" +
                                "tab:few" + "}.\n\\end{document}\n");
  const bool is_done = runs("cd '" + folder.path().string() +
                            "' && pdflatex -interaction=nonstopmode -halt-on-error paper.tex");
  const std::string log = read_whole_file(folder.path() / "paper.log");
  return is_done ? log : log + "failed";
}

std::string log_of(const ExportTable& table, const std::string& siunitx) {
  return log_of(export_latex(table), siunitx);
}

/// A table with all that can stand in one: marks, missing values, best ones, several sensors.
ExportTable full_table(const std::string& other_variant) {
  std::vector<TrialRecord> records = test::few_records();
  for (TrialRecord& record : records) {
    if (record.id.variant != "base") record.id.variant = other_variant;
  }
  records.push_back(test::unfinished({"none", "0001", "left", 0}, Status::failed, "no ground"));
  Summary summary = summarise(records, {0.5, 0.1}, {});
  Comparison comparison;
  comparison.variant = other_variant;
  comparison.base = "base";
  comparison.rotation_deg.test = {true, 1e-4, 1e-3, 1e-4, 1e-3};
  comparison.success.p_holm = 0.01;
  summary.comparisons = {comparison};
  return export_table(summary, {"few", "0123456789abcdef-dirty", 7, 2, 4, records.size(), 64});
}

/// Both versions that are in use; the older comes with the newer.
class ExportedLatex : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!has_latex()) {
      GTEST_SKIP() << "LaTeX is not here: texlive-latex-recommended, texlive-science";
    }
    if (std::string(GetParam()).find("v2") != std::string::npos &&
        !runs("kpsewhich siunitx-v2.sty")) {
      GTEST_SKIP() << "version 2 of siunitx is not here";
    }
  }
};

TEST_P(ExportedLatex, CompilesAndFitsThePage) {
  const std::string log = log_of(full_table("no volume"), GetParam());
  EXPECT_EQ(log.find("failed"), std::string::npos) << log;
  EXPECT_EQ(log.find("Overfull"), std::string::npos) << log;
}

/// A table of a large grid, whose names are as long.
ExportTable large_table() {
  std::vector<TrialRecord> records;
  for (int variant = 0; variant < 20; ++variant) {
    for (TrialRecord record : test::few_records()) {
      if (record.id.variant != "base") continue;
      record.id.variant =
          "base/cgal_efficient_ransac/point_to_plane/golden_section_" + std::to_string(variant);
      records.push_back(record);
    }
  }
  const Summary summary = summarise(records, {0.5, 0.1}, {});
  return export_table(summary, {"few", "0123456789ab", 7, 2, 4, records.size(), records.size()});
}

TEST_P(ExportedLatex, GoesOverSeveralPages) {
  const std::string log = log_of(large_table(), GetParam());
  EXPECT_EQ(log.find("failed"), std::string::npos) << log;
  EXPECT_EQ(log.find("Overfull"), std::string::npos) << log;
  EXPECT_EQ(log.find("Float too large"), std::string::npos) << log;
}

TEST_P(ExportedLatex, CompilesWithNamesThatMeanSomethingToLatex) {
  for (const char* name : {"a_b & 100 %", "#1 ~x ^2 \\par", "[b] {c $d", "*--`'<>|\"",
                           "base, volume_refinement.scorer.leaf_size_m = 0.05, icp = gicp"}) {
    const std::string log = log_of(full_table(name), GetParam());
    EXPECT_EQ(log.find("failed"), std::string::npos) << name << "\n" << log;
    EXPECT_EQ(log.find("Missing character"), std::string::npos) << name << "\n" << log;
  }
}

/// A table of six variants with long names and four sensors.
Summary six_variants() {
  std::vector<TrialRecord> records;
  for (int variant = 0; variant < 6; ++variant) {
    for (TrialRecord record : test::few_records()) {
      if (record.id.variant != "base") continue;
      record.id.variant = "base/point_to_plane/golden_section_" + std::to_string(variant);
      records.push_back(record);
    }
  }
  return summarise(records, {0.5, 0.1}, {});
}

TEST_P(ExportedLatex, CompactTablesFitOneColumnAndOnePage) {
  for (const bool is_one_column : {true, false}) {
    for (const bool is_in_mm : {true, false}) {
      TableChoice choice;
      choice.is_one_column = is_one_column;
      choice.is_in_mm = is_in_mm;
      const Summary summary = six_variants();
      const std::string latex = export_latex(export_table(
          summary, {"few", "0123456789ab", 7, 2, 4, 9, 9}, compact(choice, {summary}).front()));
      EXPECT_EQ(latex.find("continued"), std::string::npos);
      const std::string log = log_of(latex, GetParam());
      EXPECT_EQ(log.find("failed"), std::string::npos) << log;
      EXPECT_EQ(log.find("Overfull"), std::string::npos) << log << latex;
      // A table over both columns waits for the next page.
      EXPECT_NE(log.find(is_one_column ? "(1 page" : "(2 pages"), std::string::npos) << log;
    }
  }
}

/// As many columns as are let through must fit.
TEST_P(ExportedLatex, ColumnsThatAreNotRefusedFit) {
  const Summary summary = six_variants();
  for (const bool is_one_column : {true, false}) {
    TableChoice choice;
    choice.is_one_column = is_one_column;
    std::string latex;
    for (const char* name : {"success", "success_interval", "rotation_median", "translation", "x",
                             "yaw_p95", "pitch", "roll_rmse", "y", "z", "roll", "trials"}) {
      choice.columns.emplace_back(name);
      try {
        latex = export_latex(export_table(summary, {"few", "0123456789ab", 7, 2, 4, 9, 9}, choice));
      } catch (const InputError&) {
        break;
      }
    }
    EXPECT_GE(choice.columns.size(), is_one_column ? 4U : 8U);
    const std::string log = log_of(latex, GetParam());
    EXPECT_EQ(log.find("failed"), std::string::npos) << log;
    EXPECT_EQ(log.find("Overfull"), std::string::npos) << log << latex;
  }
}

INSTANTIATE_TEST_SUITE_P(Siunitx, ExportedLatex,
                         testing::Values("\\usepackage{siunitx}\n",
                                         "\\usepackage{siunitx}[=v2]\n"));

}  // namespace
}  // namespace croon::experiments

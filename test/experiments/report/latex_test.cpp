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

/// The log of a document with `table`; ends with "failed" where there is no PDF.
std::string log_of(const std::string& table, const std::string& siunitx) {
  const croon::test::TempFolder folder;
  folder.write("table.tex", table);
  folder.write("paper.tex", kHead + siunitx +
                                "\\begin{document}\nText.\n\\input{table}\n"
                                "Table~\\ref{tab:few}.\n\\end{document}\n");
  const bool is_done = runs("cd '" + folder.path().string() +
                            "' && pdflatex -interaction=nonstopmode -halt-on-error paper.tex");
  const std::string log = read_whole_file(folder.path() / "paper.log");
  return is_done ? log : log + "failed";
}

/// The table of what is chosen; by default, of the columns for a page.
std::string latex_of(const Summary& summary, TableChoice choice) {
  if (choice.columns.empty()) choice.columns = page_columns({summary}, choice.is_one_column);
  return export_latex(
      export_table(summary, {"few", "0123456789abcdef-dirty", 7, 2, 4, 9, 64}, choice));
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

/// The results of `variants` variants whose names are long.
Summary many_variants(int variants) {
  std::vector<TrialRecord> records;
  for (int variant = 0; variant < variants; ++variant) {
    for (TrialRecord record : test::few_records()) {
      if (record.id.variant != "base") continue;
      record.id.variant = "base/point_to_plane/golden_section_" + std::to_string(variant);
      records.push_back(record);
    }
  }
  return summarise(records, {0.5, 0.1}, {});
}

TEST_P(ExportedLatex, GoesOverSeveralPages) {
  const std::string log = log_of(latex_of(many_variants(54), {}), GetParam());
  for (const char* fault : {"failed", "Overfull", "Float too large"}) {
    EXPECT_EQ(log.find(fault), std::string::npos) << log;
  }
}

TEST_P(ExportedLatex, CompilesWithNamesThatMeanSomethingToLatex) {
  for (const char* name : {"a_b & 100 %", "#1 ~x ^2 \\par", "[b] {c $d", "*--`'<>|\"",
                           "base, volume_refinement.scorer.leaf_size_m = 0.05, icp = gicp"}) {
    // With marks, missing values, best ones and several sensors.
    std::vector<TrialRecord> records = test::few_records();
    for (TrialRecord& record : records) {
      if (record.id.variant != "base") record.id.variant = name;
    }
    records.push_back(test::unfinished({"none", "0001", "left", 0}, Status::failed, "no ground"));
    Summary summary = summarise(records, {0.5, 0.1}, {});
    Comparison comparison;
    comparison.variant = name;
    comparison.base = "base";
    comparison.rotation_deg.test = {true, 1e-4, 1e-3, 1e-4, 1e-3};
    comparison.success.p_holm = 0.01;
    summary.comparisons = {comparison};
    const std::string latex = latex_of(
        summary, {{}, {"success", "success_interval", "rotation_median", "rotation_paired"}});
    const std::string log = log_of(latex, GetParam());
    for (const char* fault : {"failed", "Overfull", "Missing character"}) {
      EXPECT_EQ(log.find(fault), std::string::npos) << name << "\n" << log;
    }
  }
}

TEST_P(ExportedLatex, CompactTablesFitOneColumnAndOnePage) {
  for (const bool is_one_column : {true, false}) {
    for (const bool is_in_mm : {true, false}) {
      const std::string latex = latex_of(many_variants(6), {{}, {}, is_in_mm, is_one_column, true});
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
  const Summary summary = many_variants(6);
  for (const bool is_one_column : {true, false}) {
    TableChoice choice;
    choice.is_one_column = is_one_column;
    std::string latex;
    for (const char* name : {"success", "success_interval", "rotation_median", "translation", "x",
                             "yaw_p95", "pitch", "roll_rmse", "y", "z", "roll", "trials"}) {
      choice.columns.emplace_back(name);
      try {
        latex = latex_of(summary, choice);
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

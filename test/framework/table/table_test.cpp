#include "framework/table/table.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "framework/base/text.hpp"
#include "framework/table/renderers.hpp"

namespace croon {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

struct Part {
  double low;
  std::optional<double> high;
};

struct Whole {
  std::string name;
  int count;
  Part part;
};

Columns<Part> part_columns() {
  Columns<Part> columns;
  return columns.add({"low", "ratio", "/range/0", 1}, &Part::low)
      .add({"high", "m", "/range/1", 2}, &Part::high);
}

/// A column of each kind of value, the last two below "range" in JSON.
Columns<Whole> columns() {
  Columns<Whole> columns;
  return columns.add({"name"}, &Whole::name)
      .add({"count"}, &Whole::count)
      .add({"is_many"}, [](const Whole& whole) { return whole.count > 1; })
      .add(part_columns(), &Whole::part);
}

Table two_rows() { return columns().table({{"a,b", 2, {0.25, 1.0}}, {"*c*", 1, {kInf, {}}}}); }

TEST(Columns, AreFoundByFullName) {
  EXPECT_EQ(std::get<double>(two_rows().at(0, "high_m").value), 1.0);
  EXPECT_THROW(two_rows().at(0, "high"), std::logic_error);
}

TEST(Columns, OfAMissingPartHaveNothing) {
  using Maybe = std::optional<Part>;
  Columns<Maybe> columns;
  columns.add(part_columns(), [](const Maybe& part) { return part; });
  EXPECT_TRUE(columns.cells(std::nullopt)[0].is_nothing());
  EXPECT_EQ(std::get<double>(columns.cells(Part{0.25, {}})[0].value), 0.25);
}

TEST(CsvTable, QuotesWhatNeedsIt) {
  const std::vector<Column> columns(8);
  const CellRow row = {to_cell("plain name"),
                       to_cell("a,b"),
                       to_cell("say \"a\""),
                       to_cell("two\nlines"),
                       to_cell(""),
                       {},
                       {},
                       to_cell(-1)};
  EXPECT_EQ(csv_line(columns, row), "plain name,\"a,b\",\"say \"\"a\"\"\",\"two\nlines\",,,,-1\n");
}

TEST(CsvTable, HasAColumnForMarksBehindTheOthers) {
  Table table = two_rows();
  table.columns[1].has_marks = true;
  table.rows[0][1].mark = "+*";
  EXPECT_EQ(csv_table(table),
            "name,count,is_many,low_ratio,high_m,count_mark\n"
            "\"a,b\",2,1,0.25,1,+*\n"
            "*c*,1,0,inf,,\n");
}

TEST(JsonRows, NestByPathAndHaveNoInfiniteNumbers) {
  const auto rows = json_rows(two_rows());
  EXPECT_EQ(rows.dump(), R"([{"name":"a,b","count":2,"is_many":true,"range":[0.25,1.0]},)"
                         R"({"name":"*c*","count":1,"is_many":false,"range":["inf",null]}])");
}

TEST(JsonRows, WhatHoldsNullsAloneIsNull) {
  Table table = two_rows();
  table.rows[1][3] = {};
  EXPECT_TRUE(json_rows(table)[1]["range"].is_null());
  EXPECT_FALSE(json_rows(table)[0]["range"].is_null());
}

TEST(TextTable, AlignsNamesLeftAndNumbersRight) {
  Table table{{{"group"}, {"sensor"}, {"mean ±"}, {"n"}},
              {{to_cell(""), to_cell("front"), to_cell("±0.5"), to_cell(100)},
               {to_cell("a longer line than any row"), to_cell("left-hand"), {}, to_cell(7)}}};
  View view{{{"sensor"}, {"mean ±"}, {"n"}}};
  view.heading = "group";
  EXPECT_EQ(text_table(table, view),
            "sensor     mean ±    n\n"
            "---------  ------  ---\n"
            "front        ±0.5  100\n"
            "a longer line than any row\n"
            "left-hand       -    7\n");
  EXPECT_EQ(text_table(table, view, true).substr(0, 30), "\033[1msensor     mean ±    n\033[0");
  table.rows[0].pop_back();
  EXPECT_THROW(text_table(table, view), std::logic_error);
}

TEST(TextTable, GivesNoCommandsToATerminal) {
  const Table table{{{"claim"}}, {{to_cell("a\x1b[31mb\a\nc")}}};
  const View view{{{"claim"}}};
  EXPECT_EQ(text_table(table, view), "claim\n----------\na?[31mb? c\n");
  EXPECT_EQ(markdown_table(table, view), "| claim |\n|---|\n| a?\\[31mb? c |\n");
}

TEST(View, ShowsSeveralColumnsAsOne) {
  const Table table = two_rows();
  Shown shown{"range", "[<low_ratio> to <high_m>]"};
  const auto content = [&](const CellRow& row) {
    return ShownCells(table, shown).content(row, shown_text);
  };
  EXPECT_EQ(content(table.rows[0]), "[25.0 to 1.00]");
  EXPECT_EQ(content(table.rows[1]), "[inf to -]");
  const CellRow nothing(5);
  EXPECT_EQ(content(nothing), "-");
  shown.shows_each = true;
  EXPECT_EQ(content(nothing), "[- to -]");
  EXPECT_THROW(ShownCells(table, {"range", "<width>"}), std::logic_error);
  shown = {"name", "<#0>"};
  EXPECT_EQ(content(table.rows[0]), "a,b");
}

TEST(View, HasAHeadingOnlyIfItIsLongAndTheFormatHasHeadings) {
  const Table table{{{"group"}, {"n"}}, {{to_cell("short"), to_cell(1)}}};
  const View view{{{"n"}}, 0, "group"};
  EXPECT_EQ(text_table(table, view), "group  n\n-----  -\nshort  1\n");
  EXPECT_EQ(markdown_table(table, view), "| group | n |\n|---|---:|\n| short | 1 |\n");
  EXPECT_EQ(latex_tabular(table, view),
            "\\begin{tabular}{lr}\n\\toprule\ngroup & n \\\\\n\\midrule\nshort & 1 \\\\\n"
            "\\bottomrule\n\\end{tabular}\n");
}

TEST(MarkdownTable, EscapesCellsAndBoldsTheBest) {
  Table table = two_rows();
  table.rows[0][3].is_best = true;
  table.rows[0][3].mark = "+*";
  EXPECT_EQ(markdown_table(table, {{{"name"}, {"low", "<low_ratio>"}}}),
            "| name | low |\n"
            "|---|---:|\n"
            "| a,b | **25.0** +\\* |\n"
            "| \\*c\\* | inf |\n");
}

TEST(LatexEscaped, EscapesEverything) {
  EXPECT_EQ(latex_escaped("a_b & 100 %"), "a\\_b \\& 100 \\%");
  EXPECT_EQ(latex_escaped("#1 ~ ^ \\ {x} $"),
            "\\#1 \\textasciitilde{} \\textasciicircum{} \\textbackslash{} \\{x\\} \\$");
  EXPECT_EQ(latex_escaped("[a]--<b>*"), "{[}a{]}{-}{-}\\textless{}b\\textgreater{}{*}");
}

}  // namespace
}  // namespace croon

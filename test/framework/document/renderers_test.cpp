#include "framework/document/renderers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace croon {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TableBlock variants() {
  const Table table{{{"variant"}, {"sensor"}, {"success"}},
                    {{to_cell("base"), to_cell("left"), to_cell(1)},
                     {to_cell("a|b"), to_cell("left"), to_cell(20)}}};
  View view{{{"sensor"}, {"success"}}};
  view.heading = "variant";
  return {"trials", table, view, {"of 20"}};
}

Section all_blocks() {
  Card card{"left", Tone::accepted, "accepted", {"why: a*b"}, "x 1\ny 2\n"};
  return {"one",
          "Title",
          {Paragraph{"a [link](x)"}, Paragraph{"beware", Tone::warning},
           BulletList{{"first", "second"}}, Cards{{card}}, variants(), Facts{{{"seed", "1"}}},
           Preformatted{"fixed ```"}, Picture{"a picture", "alt", "png"}},
          {{"two", "Inner *title*", {Paragraph{"inside"}}}}};
}

TEST(TextSection, ShowsAllButFigures) {
  EXPECT_EQ(text_section(all_blocks()),
            "a [link](x)\n"
            "warning: beware\n"
            "- first\n"
            "- second\n"
            "\n"
            "ACCEPTED  left\n"
            "  why: a*b\n"
            "  x 1\n"
            "  y 2\n"
            "\n"
            "trials\n"
            "variant  sensor  success\n"
            "-------  ------  -------\n"
            "base     left          1\n"
            "a|b      left         20\n"
            "of 20\n"
            "seed: 1\n"
            "fixed ```\n"
            "\n"
            "\n"
            "Inner *title*\n"
            "inside\n");
}

TEST(TextSection, HasColoursOnlyWhereAskedAndNeverCommandsFromData) {
  EXPECT_THAT(text_section(all_blocks()), Not(HasSubstr("\033")));
  EXPECT_THAT(text_section(all_blocks(), true), HasSubstr("\033[32mACCEPTED\033[0m  left"));
  const std::string hostile = "a\033[2Jb\nc\xff";
  TableBlock table = variants();
  table.caption = table.notes[0] = hostile;
  table.table.rows[0][0] = to_cell(hostile + ", which is a long name");
  const Section section{
      "id",
      "",
      {Paragraph{hostile}, BulletList{{hostile}}, Facts{{{hostile, hostile}}},
       Cards{{{hostile, Tone::plain, hostile, {hostile}, hostile}}}, Preformatted{hostile}, table},
      {{"inner", hostile, {}}}};
  EXPECT_THAT(text_section(section), Not(HasSubstr("\033")));
  EXPECT_THAT(text_section(section), Not(HasSubstr("\xff")));
}

TEST(MarkdownSection, EscapesWhatMarkdownWouldInterpret) {
  EXPECT_EQ(markdown_section(all_blocks()),
            "## Title\n\n"
            "a \\[link\\](x)\n\n"
            "beware\n\n"
            "- first\n"
            "- second\n\n"
            "**left** accepted\n\n"
            "- why: a\\*b\n\n"
            "```\nx 1\ny 2\n```\n\n"
            "trials\n\n"
            "| variant | sensor | success |\n"
            "|---|---|---:|\n"
            "| base | left | 1 |\n"
            "| a\\|b | left | 20 |\n\n"
            "of 20\n\n"
            "- seed: 1\n\n"
            "````\nfixed ```\n````\n\n"
            "### Inner \\*title\\*\n\n"
            "inside\n\n");
}

}  // namespace
}  // namespace croon

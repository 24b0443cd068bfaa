#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nettle/sha2.h>

#include <array>
#include <cstdint>
#include <regex>

#include "framework/base/base64.hpp"
#include "framework/document/renderers.hpp"
#include "test/support/occurrences.hpp"

namespace croon {
namespace {

using test::occurrences;
using ::testing::HasSubstr;
using ::testing::Not;

/// A document of every block, with `text` wherever data may appear.
Document document_of(const std::string& text) {
  const Table table{{{"name"}, {"data"}, {"share", "ratio", "", 1}},
                    {{to_cell(text), to_cell(text), to_cell(0.125)}}};
  View view{{{text, "<data>"}, {"share of %", "<share_ratio> %"}}};
  view.heading = "name";
  Drawing drawing(100.0, 10.0);
  drawing.text(0.0, 5.0, text, Anchor::start, "small");
  drawing.describe(text);
  const Picture picture{text, text, "png"};
  const Card card{text, Tone::rejected, text, {text}, text, {{text, text}}};
  const Section inner{"inner", text, {Preformatted{text}, Facts{{{text, text}}}}};
  return {text,
          text,
          {{"all",
            text,
            {Paragraph{text, Tone::note}, BulletList{{text}}, Cards{{card}},
             TableBlock{text, table, view, {text}}, Chart{text, drawing}, picture,
             FigureRow{{picture}}, CloudViewBlock{text, "{\"name\": \"</script>\"}", {picture}}},
            {inner}}},
          text};
}

class HtmlDocument : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!can_write_html()) GTEST_SKIP() << "a build without reports";
  }

  /// The page without its own scripts.
  static std::string page_of(const std::string& text) {
    const std::string page = html_document(document_of(text));
    return page.substr(0, page.find("<script>"));
  }
};

TEST_F(HtmlDocument, EscapesHostileText) {
  for (const char* hostile :
       {"</script><script>alert(1)</script>", "<!--<script>", "\"><img src=x onerror=alert(1)>",
        "' onload='alert(1)", "<style>*{}</style>", "&lt;script&gt;"}) {
    // In data, a backslash behind "<" takes its meaning away.
    const std::string page = std::regex_replace(page_of(hostile), std::regex("<\\\\"), "");
    // Text adds no tag, comment or attribute.
    for (const char* part : {"<", "<!--", "<script", "</script", "<img", "<style"}) {
      EXPECT_EQ(occurrences(page, part), occurrences(page_of("plain"), part))
          << part << " of " << hostile;
    }
    EXPECT_THAT(page, Not(HasSubstr("\"><img src=x onerror")));
  }
}

TEST_F(HtmlDocument, HasNoControlCharactersNorInvalidBytes) {
  const std::string page = page_of(std::string("a\0b\033[2J\b\xff\xc3", 10));
  EXPECT_EQ(page.find_first_of(std::string("\0\033\b\xff", 4)), std::string::npos);
  EXPECT_THAT(page, HasSubstr("\xef\xbf\xbd"));
}

TEST_F(HtmlDocument, AllowsItsOwnScriptsAlone) {
  const std::string page = html_document(document_of("a"));
  const std::size_t policy = page.find("script-src");
  const std::string allowed = page.substr(policy, page.find('>', policy) - policy);
  std::size_t scripts = 0;
  for (std::size_t at = page.find("<script>"); at != std::string::npos;
       at = page.find("<script>", at + 1)) {
    const std::size_t begin = at + 8, end = page.find("</script>", begin);
    sha256_ctx context;
    sha256_init(&context);
    sha256_update(&context, end - begin,
                  reinterpret_cast<const std::uint8_t*>(page.data() + begin));
    std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
    sha256_digest(&context, digest.size(), digest.data());
    const std::string hash = base64({reinterpret_cast<const char*>(digest.data()), digest.size()});
    EXPECT_THAT(allowed, HasSubstr("'sha256-" + hash + "'"));
    ++scripts;
  }
  EXPECT_EQ(scripts, 3U);
  EXPECT_EQ(occurrences(allowed, "'"), 2 * scripts);  // No 'unsafe-inline' or 'self'.
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
}

TEST_F(HtmlDocument, HasTheNoticeOfThreeJs) {
  EXPECT_THAT(html_document(document_of("plain")),
              HasSubstr("three.js authors\n\nPermission is hereby granted"));
}

TEST_F(HtmlDocument, IsTheSameBytesForTheSameDocument) {
  EXPECT_EQ(html_document(document_of("a")), html_document(document_of("a")));
  EXPECT_NE(html_document(document_of("a")), html_document(document_of("b")));
}

TEST_F(HtmlDocument, SortsByNumbersAndCopiesTables) {
  const std::string page = page_of("plain");
  EXPECT_THAT(page, HasSubstr("<th scope=\"col\">name</th><th scope=\"col\">plain</th>"
                              "<th scope=\"col\" class=\"number\">share of %</th>"));
  EXPECT_THAT(page, HasSubstr("<td class=\"number\" data-value=\"0.125\">12.5 %</td>"));
  EXPECT_THAT(page, HasSubstr("name,data,share_ratio\nplain,plain,0.125\n</script>"));
  EXPECT_THAT(page, HasSubstr("\\begin{tabular}{llr}\n\\toprule\nname & plain & share of \\% \\\\\n"
                              "\\midrule\nplain & plain & 12.5 \\% \\\\\n"));
}

TEST_F(HtmlDocument, ShowsEveryBlock) {
  const std::string page = page_of("plain");
  for (const char* part :
       {"<h1>plain</h1>", "<p class=\"lead\">plain</p>", "<a href=\"#all\">plain</a>",
        "<section id=\"all\"><h2>plain</h2>", "<section id=\"inner\"><h3>plain</h3>",
        "<p class=\"note\">plain</p>", "<ul class=\"points\">", "<article class=\"card rejected\">",
        "<figure class=\"chart\">", "<img alt=\"plain\" src=\"data:image/png;base64,cG5n\">",
        "<div class=\"row\">", "<figure class=\"cloud-view\" data-view=\"view-", "<pre>plain</pre>",
        "<dt>plain</dt><dd>plain</dd>", "<footer>plain</footer>"}) {
    EXPECT_THAT(page, HasSubstr(part));
  }
}

}  // namespace
}  // namespace croon

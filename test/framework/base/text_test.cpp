#include "framework/base/text.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "framework/base/error.hpp"

namespace croon::test {
namespace {

TEST(Text, ColumnsAreCodePoints) {
  EXPECT_EQ(text_columns("±1"), 2U);
  EXPECT_EQ(right_aligned("±1", 4), "  ±1");
  EXPECT_EQ(left_aligned("±1", 4), "±1  ");
  EXPECT_EQ(left_aligned("long", 2), "long");
  EXPECT_EQ(cut_to_columns("straße", 6), "straße");
  EXPECT_EQ(cut_to_columns("straße", 5), "stra…");
  EXPECT_EQ(cut_to_columns("ßßß", 2), "ß…");
  EXPECT_EQ(cut_to_columns("abc", 0), "");
}

TEST(Text, CutsInTheMiddle) {
  EXPECT_EQ(cut_in_the_middle("abcdefgh", 8), "abcdefgh");
  EXPECT_EQ(cut_in_the_middle("abcdefgh", 7), "abc…fgh");
  EXPECT_EQ(cut_in_the_middle("abcdefgh", 4), "a…gh");
  EXPECT_EQ(cut_in_the_middle("±±±±ß", 3), "±…ß");
  EXPECT_EQ(cut_in_the_middle("abc", 2), "…c");
  EXPECT_EQ(cut_in_the_middle("abc", 1), "…");
}

TEST(Text, FixedNumbers) {
  EXPECT_EQ(fixed_number(1.0 / 3.0, 3), "0.333");
  EXPECT_EQ(fixed_number(-1.25, 1), "-1.2");
  EXPECT_EQ(fixed_number(-0.0004, 3), "0.000");
  EXPECT_EQ(fixed_number(-0.0006, 3), "-0.001");
  EXPECT_EQ(fixed_number(-0.0, 0), "0");
  EXPECT_EQ(fixed_number(-std::numeric_limits<double>::infinity(), 2), "-inf");
  EXPECT_EQ(fixed_number(std::numeric_limits<double>::quiet_NaN(), 2), "nan");
}

TEST(Text, PlainNumbersHaveNoExponent) {
  EXPECT_EQ(plain_number(-5e-4), "-0.0005");
  EXPECT_EQ(plain_number(94.7), "94.7");
  EXPECT_EQ(plain_number(100.0), "100");
  EXPECT_EQ(plain_number(-0.0), "0");
  EXPECT_EQ(plain_number(-1.5e300), "-1.5e+300");
  EXPECT_EQ(plain_number(5e-324).size(), 326U);
}

TEST(Text, Clock) {
  EXPECT_EQ(clock_text(0.4), "0:00");
  EXPECT_EQ(clock_text(59.6), "1:00");
  EXPECT_EQ(clock_text(3723.0), "1:02:03");
  EXPECT_EQ(clock_text(std::numeric_limits<double>::infinity()), "277777:46:40");
}

TEST(Text, IsPrintableWithoutControlCharactersAndBrokenCodes) {
  EXPECT_EQ(printable("a b\tc\x1b[31m\x7f\n"), "a b?c?[31m??");
  EXPECT_EQ(printable("Stra\xc3\x9f"
                      "e \xe2\x82\xac \xf0\x9f\x9a\x97"),
            "Stra\xc3\x9f"
            "e \xe2\x82\xac \xf0\x9f\x9a\x97");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "?31m");  // A control character of two bytes.
  for (const char* broken :
       {"\xff", "\xc3", "\x80", "\xc0\xaf", "\xed\xa0\x80", "\xf5\x80\x80\x80"}) {
    EXPECT_EQ(printable(broken).find_first_not_of('?'), std::string::npos);
  }
  const std::string all = printable(std::string("\xe2\x82", 2) + "a");
  EXPECT_EQ(all, "??a");
}

TEST(Text, IsPrintableWithoutWhatIsNotSeen) {
  // A mark from right to left, a separator of lines, a space without width, a byte order mark, a
  // soft hyphen, a tag.
  for (const char* unseen : {"\xe2\x80\xae", "\xe2\x80\xa8", "\xe2\x80\x8b", "\xef\xbb\xbf",
                             "\xc2\xad", "\xf3\xa0\x80\xa1"}) {
    EXPECT_EQ(printable(std::string("le") + unseen + "ft"), "le?ft");
  }
  // Their neighbours are seen: no-break space, dash, ideographic space.
  for (const char* seen : {"\xc2\xa0", "\xe2\x80\x94", "\xe3\x80\x80"}) {
    EXPECT_EQ(printable(seen), seen);
  }
}

TEST(Text, OfAFaultIsShort) {
  const std::string key(1000000, 'k');
  EXPECT_LT(Fault({"f.json", "/" + key, "unknown key \"" + key + "\""}).line().size(), 2300U);
  EXPECT_EQ(Fault({"\x1b]0;f", "/a", "b"}).line(), "?]0;f: /a: b");
}

}  // namespace
}  // namespace croon::test

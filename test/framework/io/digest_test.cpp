#include "framework/io/digest.hpp"

#include <gtest/gtest.h>

#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

TEST(Digest, IsSha256) {
  // FIPS 180-2, appendix B, and the digest of the empty text.
  EXPECT_EQ(sha256_of_text("abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of_text(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Digest, OfAFileIsThatOfItsBytes) {
  const test::TempFolder folder;
  for (const std::string& bytes :
       {std::string(), std::string("a\0b\r\n", 5), std::string(100000, 'x')}) {
    EXPECT_EQ(sha256_of_file(folder.write("a", bytes)), sha256_of_text(bytes));
  }
  EXPECT_NE(test::input_error([&] { sha256_of_file(folder.path() / "none"); }), "");
  EXPECT_NE(test::input_error([&] { sha256_of_file(folder.path()); }), "");
}

}  // namespace
}  // namespace croon

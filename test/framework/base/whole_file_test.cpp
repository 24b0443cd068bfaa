#include "framework/base/whole_file.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::size_t files_in(const std::filesystem::path& folder) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) count += entry.exists();
  return count;
}

TEST(WholeFile, ReadsWhatItWroteAndLeavesNothingElse) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.path() / "a";
  for (const std::string& bytes :
       {std::string("first"), std::string("\0\r\n\xff", 4), std::string()}) {
    write_whole_file(path, bytes);
    EXPECT_EQ(read_whole_file(path), bytes);
    EXPECT_EQ(files_in(folder.path()), 1u);
  }
}

TEST(WholeFile, InPartsIsCompleteOrUnchanged) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.path() / "a";
  write_in_parts(path, [](const auto& append) {
    append("first, ");
    append("last");
  });
  EXPECT_EQ(read_whole_file(path), "first, last");
  const auto fail = [](const auto& append) {
    append("other");
    throw InputError("b", "", "is damaged");
  };
  EXPECT_THROW(write_in_parts(path, fail), InputError);
  EXPECT_EQ(read_whole_file(path), "first, last");
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(WholeFile, GoesOnBesideAPartThatACrashLeft) {
  const test::TempFolder folder;
  folder.write("a.part0", "left over");
  write_whole_file(folder.path() / "a", "new");
  EXPECT_EQ(read_whole_file(folder.path() / "a"), "new");
  EXPECT_EQ(read_whole_file(folder.path() / "a.part0"), "left over");
}

TEST(WholeFile, TakesAPartThatAKillLeft) {
  const test::TempFolder folder;
  folder.write("a.croon-part0", "left over and longer");
  EXPECT_TRUE(is_part_of(folder.path() / "a.croon-part0", folder.path() / "a"));
  EXPECT_FALSE(is_part_of(folder.path() / "a.part0", folder.path() / "a"));
  write_whole_file(folder.path() / "a", "new");
  EXPECT_EQ(read_whole_file(folder.path() / "a"), "new");
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(WholeFile, WritesThroughNoLink) {
  for (const bool is_hard : {false, true}) {
    const test::TempFolder folder;
    const auto other = folder.write("other/file", "kept");
    const auto part = folder.path() / "a.croon-part0";
    is_hard ? std::filesystem::create_hard_link(other, part)
            : std::filesystem::create_symlink(other, part);
    write_whole_file(folder.path() / "a", "new");
    EXPECT_EQ(read_whole_file(other), "kept");
    EXPECT_EQ(read_whole_file(folder.path() / "a"), "new");
  }
}

TEST(WholeFile, LeavesThePartOfAnotherWriterAlone) {
  const test::TempFolder folder;
  const auto part = folder.write("a.croon-part0", "at work");
  const int descriptor = ::open(part.c_str(), O_RDONLY);
  ASSERT_EQ(::flock(descriptor, LOCK_EX), 0);
  write_whole_file(folder.path() / "a", "new");
  EXPECT_EQ(read_whole_file(part), "at work");
  EXPECT_EQ(files_in(folder.path()), 2u);
  ::close(descriptor);
}

TEST(WholeFile, BeginsWithItsFirstBytesAndIsNoLink) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.path() / "a";
  write_whole_file(path, "begin, end");
  EXPECT_TRUE(file_begins_with(path, ""));
  EXPECT_TRUE(file_begins_with(path, "begin"));
  EXPECT_TRUE(file_begins_with(path, "begin, end"));
  EXPECT_FALSE(file_begins_with(path, "begin, end."));
  EXPECT_FALSE(file_begins_with(path, "end"));
  EXPECT_FALSE(file_begins_with(folder.path() / "none", ""));
  EXPECT_FALSE(file_begins_with(folder.path(), ""));
  std::filesystem::create_symlink(path, folder.path() / "link");
  EXPECT_FALSE(file_begins_with(folder.path() / "link", "begin"));
}

TEST(WholeFile, RefusesWhatIsNoFile) {
  const test::TempFolder folder;
  const std::filesystem::path missing = folder.path() / "none" / "a";
  EXPECT_THAT(test::input_error([&] { write_whole_file(missing, "x"); }),
              HasSubstr(missing.string()));
  EXPECT_THAT(test::input_error([&] { write_whole_file(folder.path(), "x"); }),
              HasSubstr("found a folder"));
  EXPECT_THAT(test::input_error([&] { read_whole_file(missing); }), HasSubstr("found none"));
  EXPECT_THAT(test::input_error([&] { read_whole_file(folder.path()); }),
              HasSubstr("found a folder"));
  std::filesystem::create_symlink("nowhere", folder.path() / "link");
  EXPECT_THAT(test::input_error([&] { read_whole_file(folder.path() / "link"); }),
              HasSubstr("found a link that leads nowhere"));
  std::filesystem::remove(folder.path() / "link");
  EXPECT_EQ(read_file_if_there(missing), std::nullopt);
  EXPECT_THROW(read_file_if_there(folder.path()), InputError);
  EXPECT_EQ(files_in(folder.path()), 0u);
}

TEST(WholeFile, RefusesAFileByItsSize) {
  const test::TempFolder folder;
  const auto huge = folder.write("huge", "");
  std::filesystem::resize_file(huge, 40'000'000'000);
  EXPECT_THAT(test::input_error([&] { read_whole_file(huge); }),
              AllOf(HasSubstr("huge: expected a file of at most "),
                    HasSubstr(" bytes, found one of 40000000000")));
}

}  // namespace
}  // namespace croon

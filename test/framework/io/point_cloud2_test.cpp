#include "framework/io/point_cloud2.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/io/cdr.hpp"
#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

using ::testing::HasSubstr;

/// Writes CDR, little- or big-endian, as the test needs it.
class CdrText {
 public:
  explicit CdrText(ByteOrder order = ByteOrder::little) : order_(order) {
    bytes_ = std::string("\0\0\0\0", 4);
    bytes_[1] = order == ByteOrder::little ? '\1' : '\0';
  }
  CdrText& number(std::uint32_t value) {
    while (bytes_.size() % 4 != 0) bytes_ += '\0';
    for (unsigned i = 0; i < 4; ++i) {
      bytes_ += static_cast<char>(value >> (order_ == ByteOrder::little ? 8 * i : 24 - 8 * i));
    }
    return *this;
  }
  CdrText& byte(std::uint8_t value) {
    bytes_ += static_cast<char>(value);
    return *this;
  }
  CdrText& text(const std::string& value) {
    number(static_cast<std::uint32_t>(value.size() + 1));
    bytes_ += value + '\0';
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  ByteOrder order_;
  std::string bytes_;
};

/// A message whose values a test can make wrong.
struct MessageSpec {
  std::uint32_t height = 1, width = 2;
  std::vector<std::string> fields = {"x", "y", "z"};
  std::uint32_t last_offset = 8;
  std::uint8_t datatype = 7;
  std::uint32_t count = 1;
  std::uint8_t is_big_endian = 0;
  std::uint32_t point_step = 12, row_step = 24;
  std::uint32_t data_bytes = 24;
  std::string more = {};  ///< Behind the end.
};

std::string message_of(const MessageSpec& spec, ByteOrder order = ByteOrder::little) {
  CdrText text(order);
  text.number(1700000000).number(500000000).text("lidar").number(spec.height).number(spec.width);
  text.number(static_cast<std::uint32_t>(spec.fields.size()));
  for (std::size_t i = 0; i < spec.fields.size(); ++i) {
    const bool is_last = i + 1 == spec.fields.size();
    text.text(spec.fields[i])
        .number(is_last ? spec.last_offset : 4 * static_cast<std::uint32_t>(i))
        .byte(is_last ? spec.datatype : 7)
        .number(is_last ? spec.count : 1);
  }
  text.byte(spec.is_big_endian).number(spec.point_step).number(spec.row_step);
  text.number(spec.data_bytes);
  // 1, 2, 3, … as float, little-endian.
  for (std::uint32_t i = 0; i < spec.data_bytes; ++i) {
    const float value = static_cast<float>(i / 4 + 1);
    text.byte(static_cast<std::uint8_t>(reinterpret_cast<const char*>(&value)[i % 4]));
  }
  text.byte(1);
  return text.bytes() + spec.more;
}

LoadedCloud cloud_in(const std::string& message) {
  return read_point_cloud2(message, 1.7e9, {"drive.mcap", "/points, message 1", "", {}});
}

std::string error_of(const MessageSpec& spec) {
  return test::input_error([&] { cloud_in(message_of(spec)); });
}

TEST(PointCloud2, IsReadInBothByteOrdersOfCdr) {
  for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
    const std::string message = message_of({}, order);
    EXPECT_EQ(cloud_in(message).points, (Points{{1, 2, 3}, {4, 5, 6}}));
    const std::optional<MessageHeader> header = read_message_header(message);
    ASSERT_TRUE(header.has_value());
    EXPECT_EQ(header->stamp_s, 1700000000.5);
    EXPECT_EQ(header->frame, "lidar");
    EXPECT_EQ(read_message_header(message.substr(0, 15))->frame, "");
    EXPECT_EQ(read_message_header(message.substr(0, 11)), std::nullopt);
  }
}

TEST(PointCloud2, AllowsWhatDriversWrite) {
  EXPECT_EQ(error_of({}), "");
  MessageSpec spec;
  spec.row_step = 0;
  EXPECT_EQ(error_of(spec), "") << "a single row without its step";
  spec = {};
  spec.count = 0;
  EXPECT_EQ(error_of(spec), "") << "single numbers without their count";
  spec = {};
  spec.more = std::string(3, '\0');
  EXPECT_EQ(error_of(spec), "") << "padding";
  spec = {};
  spec.width = spec.data_bytes = spec.row_step = 0;
  EXPECT_EQ(error_of(spec), "") << "no points";
}

TEST(PointCloud2, RefusesMessagesThatContradictThemselves) {
  MessageSpec spec;
  spec.fields = {"x", "y", "height"};
  EXPECT_THAT(error_of(spec), HasSubstr("drive.mcap: /points, message 1: expected the fields x, y "
                                        "and z, found x, y, height"));
  spec.fields = {"x", "y", "y"};
  EXPECT_THAT(error_of(spec), HasSubstr("duplicate field \"y\""));
  spec = {};
  spec.datatype = 9;
  EXPECT_THAT(error_of(spec), HasSubstr("datatype from 1 to 8 for the field \"z\", found 9"));
  spec = {};
  spec.last_offset = 9;
  EXPECT_THAT(error_of(spec), HasSubstr("found its end at byte 13"));
  spec = {};
  spec.count = 0xffffffff;
  EXPECT_THAT(error_of(spec), HasSubstr("expected the field \"z\" within the 12 bytes"));
  spec = {};
  spec.is_big_endian = 2;
  EXPECT_THAT(error_of(spec), HasSubstr("expected true or false, found the byte 2"));
  spec = {};
  spec.more = std::string(8, '\0');
  EXPECT_THAT(error_of(spec), HasSubstr("expected the end of the message"));
  for (const std::uint32_t huge : {3U, 0x80000000U, 0xffffffffU}) {
    spec = {};
    spec.width = huge;
    EXPECT_THAT(error_of(spec), HasSubstr("points of 12 bytes, found 24 bytes"));
    spec.height = huge;
    EXPECT_THAT(error_of(spec), HasSubstr("points of 12 bytes, found 24 bytes"));
    spec.fields = {};
    EXPECT_THAT(error_of(spec), HasSubstr("points of 12 bytes, found 24 bytes"));
    spec.point_step = 0;
    EXPECT_THAT(error_of(spec), HasSubstr("points of 0 bytes"));
  }
}

TEST(PointCloud2, CutAnywhereIsOneError) {
  const std::string message = message_of({});
  for (std::size_t size = 0; size < message.size(); ++size) {
    const std::string error = test::input_error([&] { cloud_in(message.substr(0, size)); });
    EXPECT_THAT(error, HasSubstr("drive.mcap: /points, message 1: "));
  }
}

TEST(PointCloud2, IsInPlainCdrOnly) {
  std::string message = message_of({});
  message[1] = 7;
  EXPECT_THAT(test::input_error([&] { cloud_in(message); }), HasSubstr("the encoding 0x0007"));
}

TEST(CdrReader, AlignsNumbersToTheirSize) {
  const std::string message = CdrText().byte(7).number(8).text("ab").byte(1).number(9).bytes();
  CdrReader reader(message, {"file", "", "", {}});
  EXPECT_EQ(reader.read_uint8(), 7);
  EXPECT_EQ(reader.read_int32(), 8);
  EXPECT_EQ(reader.read_string(), "ab");
  EXPECT_TRUE(reader.read_bool());
  EXPECT_EQ(reader.read_uint32(), 9U);
  reader.expect_end();
  EXPECT_THAT(test::input_error([&] { reader.read_uint8(); }), HasSubstr("damaged"));
}

TEST(CdrReader, NeedsTheZeroByteOfATextAndRoomForASequence) {
  const std::string text = CdrText().number(2).byte('a').byte('b').bytes();
  EXPECT_THAT(test::input_error([&] {
                CdrReader(text, {"f", "", "", {}}).read_string();
              }),
              HasSubstr("zero byte"));
  EXPECT_THAT(test::input_error([&] {
                CdrReader(text, {"f", "", "", {}}).read_length(16);
              }),
              HasSubstr("expected 2 elements"));
}

}  // namespace
}  // namespace croon

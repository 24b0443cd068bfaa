#include "framework/io/cdr.hpp"

#include <utility>

#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

constexpr std::size_t kEncapsulationBytes = 4;

std::string hexadecimal(std::string_view bytes) {
  std::string text = "0x";
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += "0123456789abcdef"[byte / 16];
    text += "0123456789abcdef"[byte % 16];
  }
  return text;
}

}  // namespace

CdrReader::CdrReader(std::string_view message, Fault place) : place_(std::move(place)) {
  if (message.size() < kEncapsulationBytes) {
    fail("expected a message in CDR, found " + std::to_string(message.size()) + " bytes");
  }
  const std::string_view encoding = message.substr(0, 2);
  if (encoding[0] != 0 || (encoding[1] != 0 && encoding[1] != 1)) {
    fail("expected a message in CDR (0x0000 or 0x0001), found the encoding " +
         hexadecimal(encoding));
  }
  order_ = encoding[1] == 0 ? ByteOrder::big : ByteOrder::little;
  body_ = message.substr(kEncapsulationBytes);
}

std::uint8_t CdrReader::read_uint8() { return static_cast<std::uint8_t>(take(1, 1)[0]); }

std::uint32_t CdrReader::read_uint32() {
  const std::string_view bytes = take(4, 4);
  return static_cast<std::uint32_t>(
      decode_scalar({ScalarKind::unsigned_integer, 4}, order_, bytes.data()));
}

std::int32_t CdrReader::read_int32() {
  const std::string_view bytes = take(4, 4);
  return static_cast<std::int32_t>(
      decode_scalar({ScalarKind::signed_integer, 4}, order_, bytes.data()));
}

bool CdrReader::read_bool() {
  const std::uint8_t value = read_uint8();
  if (value > 1) fail("expected true or false, found the byte " + std::to_string(value));
  return value == 1;
}

std::string_view CdrReader::read_string() {
  const std::uint32_t length = read_uint32();
  // Some writers omit the zero byte of an empty string.
  if (length == 0) return {};
  const std::string_view text = take(length, 1);
  if (text.back() != '\0') fail("expected a zero byte after " + in_quotes(text));
  return text.substr(0, text.size() - 1);
}

std::string_view CdrReader::read_octets() {
  const std::uint32_t length = read_uint32();
  return take(length, 1);
}

std::uint32_t CdrReader::read_length(std::size_t min_element_bytes) {
  const std::uint32_t length = read_uint32();
  const std::size_t left = body_.size() - next_;
  if (length > left / min_element_bytes) {
    fail("expected " + std::to_string(length) + " elements, found " + std::to_string(left) +
         " bytes");
  }
  return length;
}

void CdrReader::expect_end() const {
  // Middleware pads a message to a multiple of 4 or 8 bytes.
  constexpr std::size_t kMaxPaddingBytes = 7;
  const std::size_t left = body_.size() - next_;
  if (left > kMaxPaddingBytes) {
    fail("expected the end of the message, found " + std::to_string(left) + " more bytes");
  }
}

void CdrReader::fail(const std::string& message) const {
  throw InputError(place_.file, place_.where, message);
}

std::string_view CdrReader::take(std::size_t count, std::size_t alignment) {
  const std::size_t begin = (next_ + alignment - 1) / alignment * alignment;
  if (begin > body_.size() || count > body_.size() - begin) {
    fail("the message is damaged: expected " + std::to_string(count) + " bytes at byte " +
         std::to_string(begin + kEncapsulationBytes) + ", found its end at " +
         std::to_string(body_.size() + kEncapsulationBytes));
  }
  next_ = begin + count;
  return body_.substr(begin, count);
}

}  // namespace croon

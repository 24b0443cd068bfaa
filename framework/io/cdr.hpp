#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "framework/base/error.hpp"
#include "framework/base/scalar_type.hpp"

namespace croon {

/// Reads a message in the Common Data Representation (XCDR1, the encoding of ROS 2 and DDS) value
/// by value, in the byte order that its first four bytes declare. Returns views into the message,
/// which must outlive the reader. Every function throws InputError if the message ends too early or
/// a value is invalid for its type.
class CdrReader {
 public:
  /// `place` has the file and position for errors. Throws InputError if the first bytes declare
  /// another encoding.
  CdrReader(std::string_view message, Fault place);

  std::uint8_t read_uint8();
  std::uint32_t read_uint32();
  std::int32_t read_int32();
  bool read_bool();
  /// Reads a string, without its terminating zero byte.
  std::string_view read_string();
  /// Reads a sequence of octets.
  std::string_view read_octets();
  /// Reads the length of a sequence whose elements have at least `min_element_bytes` bytes each.
  std::uint32_t read_length(std::size_t min_element_bytes);
  /// Throws InputError if anything but padding follows.
  void expect_end() const;

  [[noreturn]] void fail(const std::string& message) const;

 private:
  /// The next `count` bytes, after padding to a multiple of `alignment`.
  std::string_view take(std::size_t count, std::size_t alignment);

  std::string_view body_;  ///< Without the first four bytes; alignment is relative to its start.
  std::size_t next_ = 0;
  ByteOrder order_ = ByteOrder::little;
  Fault place_;
};

}  // namespace croon

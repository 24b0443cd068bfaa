#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "framework/base/error.hpp"
#include "framework/base/scalar_type.hpp"

namespace croon {

/// Reads a message in the Common Data Representation (XCDR1, the encoding of ROS 2 and DDS) value
/// by value, in the byte order that its first four bytes declare. Views into the message, which
/// must outlive it. Every function throws InputError where the message ends too early or has a
/// value that its type cannot have.
class CdrReader {
 public:
  /// `place` is the file and the position in it of errors. Throws InputError if the first bytes
  /// declare another encoding.
  CdrReader(std::string_view message, Fault place);

  std::uint8_t read_uint8();
  std::uint32_t read_uint32();
  std::int32_t read_int32();
  bool read_bool();
  /// Text without the zero byte at its end.
  std::string_view read_string();
  /// The bytes of a sequence of octets.
  std::string_view read_octets();
  /// The length of a sequence whose elements have at least `min_element_bytes` bytes each.
  std::uint32_t read_length(std::size_t min_element_bytes);
  /// Throws InputError if more than padding follows.
  void expect_end() const;

  [[noreturn]] void fail(const std::string& message) const;

 private:
  /// The next `count` bytes, after padding to a multiple of `alignment`.
  std::string_view take(std::size_t count, std::size_t alignment);

  std::string_view body_;  ///< Without the first four bytes, from which alignment counts.
  std::size_t next_ = 0;
  ByteOrder order_ = ByteOrder::little;
  Fault place_;
};

}  // namespace croon

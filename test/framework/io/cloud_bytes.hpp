#pragma once

#include <string>
#include <vector>

#include "framework/base/scalar_type.hpp"
#include "framework/geometry/point_cloud.hpp"
#include "framework/io/pcd_header.hpp"

namespace croon::test {

/// One field of a PCD file that a test writes.
struct FieldSpec {
  std::string name;
  char type = 'F';
  std::size_t size = 4;
  std::size_t count = 1;
};

/// A PCD file that a test writes: an implementation of the format of its own, to hold the reader
/// against.
struct PcdSpec {
  std::vector<FieldSpec> fields = {{"x"}, {"y"}, {"z"}};
  std::string data = "binary";
  std::string version = "0.7";
  std::string line_end = "\n";
};

/// The file's header alone.
std::string pcd_header(const PcdSpec& spec, std::size_t points);

/// The file; fields that are not x, y, z hold sevens.
std::string pcd_bytes(const PcdSpec& spec, const Points& cloud);

/// The bytes of one number.
std::string scalar_bytes(char type, std::size_t size, double value, ByteOrder order);

}  // namespace croon::test

#pragma once

#include <string>

namespace croon::test {

/// A PCD file with one point, (x, 0, 0) m.
inline std::string one_point_pcd(int x_m) {
  return "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nDATA ascii\n" + std::to_string(x_m) +
         " 0 0\n";
}

}  // namespace croon::test

#include "framework/simulation/material.hpp"

#include <array>

namespace croon::simulation {

const MaterialLook& look_of(Material material) {
  // In the order of the enumeration.
  static const std::array<MaterialLook, 19> looks = {{{0.17, 0.0, {88, 90, 94}},
                                                      {0.45, 0.25, {232, 232, 226}},
                                                      {0.35, 0.0, {166, 164, 158}},
                                                      {0.30, 0.0, {150, 144, 138}},
                                                      {0.50, 0.0, {108, 140, 82}},
                                                      {0.35, 0.0, {158, 98, 80}},
                                                      {0.60, 0.0, {212, 202, 184}},
                                                      {0.08, 0.0, {96, 122, 140}},
                                                      {0.40, 0.0, {140, 144, 150}},
                                                      {0.50, 0.0, {180, 62, 56}},
                                                      {0.70, 0.0, {226, 226, 222}},
                                                      {0.10, 0.0, {52, 54, 60}},
                                                      {0.35, 0.0, {58, 88, 140}},
                                                      {0.05, 0.0, {38, 38, 40}},
                                                      {0.30, 0.0, {104, 80, 60}},
                                                      {0.45, 0.0, {76, 120, 62}},
                                                      {0.40, 0.0, {70, 84, 140}},
                                                      {0.40, 0.0, {150, 116, 78}},
                                                      {0.40, 0.80, {60, 110, 190}}}};
  return looks[static_cast<std::size_t>(material)];
}

}  // namespace croon::simulation

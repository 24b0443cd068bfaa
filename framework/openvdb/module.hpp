#pragma once

#include "framework/openvdb/voxels.hpp"

namespace croon::voxels {

/// The functions of voxels.hpp in the module that on_demand.cpp loads, where they are the variable
/// `croon_openvdb`. The module and its program are of one build.
struct Module {
  decltype(&make_tree) tree;
  decltype(&occupancy_file) file;
};

}  // namespace croon::voxels

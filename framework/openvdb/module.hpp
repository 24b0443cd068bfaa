#pragma once

#include "framework/openvdb/voxels.hpp"

namespace croon::voxels {

/// The functions of voxels.hpp in the module that on_demand.cpp loads, as the variable
/// `croon_openvdb` there. The module and its program must be from the same build.
struct Module {
  decltype(&make_tree) tree;
  decltype(&occupancy_file) file;
};

}  // namespace croon::voxels

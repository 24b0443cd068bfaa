#include "framework/openvdb/module.hpp"

extern "C" {
extern const croon::voxels::Module croon_openvdb;
const croon::voxels::Module croon_openvdb{&croon::voxels::make_tree,
                                          &croon::voxels::occupancy_file};
}

#include <dlfcn.h>

#include <filesystem>

#include "framework/base/error.hpp"
#include "framework/openvdb/module.hpp"

namespace croon::voxels {
namespace {

/// Loads the module. Throws InputError if it is not where it was built or installed.
const Module& load_module() {
  // The folders of the program and the module are moved together, so the relative path stays valid.
  const std::filesystem::path program = std::filesystem::canonical("/proc/self/exe");
  const std::filesystem::path path =
      (program.parent_path() / CROON_OPENVDB_MODULE).lexically_normal();
  // Never closed: trees of the module may live as long as the program.
  void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  const void* const module = library == nullptr ? nullptr : dlsym(library, "croon_openvdb");
  if (module == nullptr) {
    throw InputError(
        path.string(), "",
        std::string("cannot load the OpenVDB module of croon, which belongs to the program ") +
            program.string() + ": " + dlerror());
  }
  return *static_cast<const Module*>(module);
}

const Module& module() {
  static const Module& loaded = load_module();
  return loaded;
}

}  // namespace

std::unique_ptr<const Tree> make_tree(const Indices& voxels) { return module().tree(voxels); }

std::string occupancy_file(const Indices& voxels, double size_m) {
  return module().file(voxels, size_m);
}

}  // namespace croon::voxels

#include "registry/registry.hpp"

namespace croon {

/// Generated, see registry/CMakeLists.txt.
void add_all_stages(Catalogue& catalogue);

const Catalogue& registry() {
  static const Catalogue catalogue = [] {
    Catalogue all;
    add_all_stages(all);
    return all;
  }();
  return catalogue;
}

}  // namespace croon

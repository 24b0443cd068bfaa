#pragma once

#include <map>
#include <memory>
#include <string>
#include <typeinfo>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/params/data_flow.hpp"

namespace croon {

/// The name of a value of the type `T` that one step adds to the estimate and a later one reads. A
/// header declares it once, and both steps include that header:
///
///     inline constexpr Extra<double> kOverlap{"overlap_ratio", "the share of common surface"};
template <class T>
struct Extra {
  const char* name;
  const char* meaning;  ///< Description for help.

  params::ExtraDoc doc() const { return {name, typeid(T).name(), meaning}; }
};

/// The flow of a step that reads these extras.
template <class... T>
params::DataFlow takes(const Extra<T>&... extras) {
  return {{}, {}, {extras.doc()...}, {}};
}

/// The flow of a step that provides these extras.
template <class... T>
params::DataFlow gives(const Extra<T>&... extras) {
  return {{}, {}, {}, {extras.doc()...}};
}

/// The values that steps add to an estimate for later steps, by name. Cheap to copy: values are
/// shared and immutable.
class Extras {
 public:
  /// Stores a value, replacing one of the same name.
  template <class T>
  void put(const Extra<T>& extra, T value) {
    items_[extra.name] = {typeid(T).name(), std::make_shared<const T>(std::move(value))};
  }

  /// The value, or null if no value has this name and type.
  template <class T>
  const T* find(const Extra<T>& extra) const {
    const auto found = items_.find(extra.name);
    if (found == items_.end() || found->second.type != typeid(T).name()) return nullptr;
    return static_cast<const T*>(found->second.value.get());
  }

  /// The value. Throws StageError if there is none; if the step declares it in its `data_flow`, the
  /// pipeline is refused before that.
  template <class T>
  const T& get(const Extra<T>& extra) const {
    if (const T* const value = find(extra)) return *value;
    throw StageError(std::string("no earlier step provides the extra \"") + extra.name + "\"");
  }

 private:
  struct Item {
    std::string type;
    std::shared_ptr<const void> value;
  };
  std::map<std::string, Item> items_;
};

}  // namespace croon

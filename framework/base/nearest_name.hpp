#pragma once

#include <string>
#include <vector>

namespace croon {

/// The known name with the least edit distance to `name`, or nothing where none is near enough (all
/// of it or more than half of a long name differs).
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

/// `; did you mean "ransac"?`, or, where nothing is near, `; known: a, b, c`. Empty where nothing
/// is known.
std::string name_hint(const std::string& name, const std::vector<std::string>& known);

}  // namespace croon

#pragma once

#include <string_view>
#include <vector>

namespace croon {

/// Sets `fields` to the fields of `line`, including the blanks around them; a blank as `separator`
/// means any number of blanks and tabs. An empty field at the end is omitted.
void split_fields(std::string_view line, char separator, std::vector<std::string_view>& fields);

}  // namespace croon

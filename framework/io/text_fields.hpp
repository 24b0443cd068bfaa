#pragma once

#include <string_view>
#include <vector>

namespace croon {

/// Makes `fields` those of `line` between separators, with the blanks around them; a blank as
/// separator stands for any number of blanks and tabs. An empty field at the end is left out.
void split_fields(std::string_view line, char separator, std::vector<std::string_view>& fields);

}  // namespace croon

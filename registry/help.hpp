#pragma once

#include <string>

#include "framework/stage/catalogue.hpp"

namespace croon {

/// How the help on stages is written.
enum class HelpFormat { text, json, markdown };

/// The help on the stages of `catalogue` that `which` names: all of them (""), those of a kind
/// ("icp"), or one with its parameters ("icp/icpn"). Ends with a newline. Throws InputError, with
/// the nearest name, where there is no such kind or stage. `croon stages` prints this; the Markdown
/// of each kind is docs/stages/.
std::string stages_help(const Catalogue& catalogue, const std::string& which, HelpFormat format);

}  // namespace croon

#pragma once

#include <string>

#include "framework/stage/catalogue.hpp"

namespace croon {

/// The formats of the help on stages.
enum class HelpFormat { text, json, markdown };

/// Parses "text", "json" or "markdown". Throws InputError at "format" for another name.
HelpFormat help_format(const std::string& name);

/// The help for the stages of `catalogue` that `which` names: all (""), those of a kind ("icp"), or
/// one with its parameters ("icp/icpn"). Ends with a newline. Throws InputError with the nearest
/// name if the kind or stage does not exist. `croon stages` prints this; the Markdown of each kind
/// is docs/stages/.
std::string stages_help(const Catalogue& catalogue, const std::string& which, HelpFormat format);

}  // namespace croon

#pragma once

#include "framework/params/group.hpp"

namespace croon::experiments {

/// The name of an experiment, which is also the name of a folder.
inline const params::NameRule kFolderName = {
    "_.-", "a name for a folder: letters, digits, _ . and -, not starting with a dot", "."};

/// A variant's name. It stands in CSV files and in paths.
inline const params::NameRule kVariantName = {
    "_.-+=() ", "a name of letters, digits, spaces and _ . - + = ( ), not starting with a dot",
    ". ", " "};

}  // namespace croon::experiments

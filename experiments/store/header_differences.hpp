#pragma once

#include <string>
#include <vector>

#include "experiments/store/store_header.hpp"

namespace croon::experiments {

/// The differences that keep the trials of `stored` and of `asked` apart, each as
/// "/starts/rotation_deg was 45 and is 30". A variant that only one of them has is no difference.
std::vector<std::string> differences(const StoreHeader& stored, const StoreHeader& asked);

/// Throws InputError if there are `differences`. `file` is the store; `remedy` says what the user
/// can do.
void refuse_differences(const std::string& file, const StoreHeader& stored,
                        const StoreHeader& asked, const std::string& remedy);

}  // namespace croon::experiments

#pragma once

#include <string>
#include <vector>

#include "experiments/store/store_header.hpp"

namespace croon::experiments {

/// Why the trials of `stored` and those of `asked` do not belong together: each difference as
/// "/starts/rotation_deg was 45 and is 30". Variants that only one of them has are none.
std::vector<std::string> differences(const StoreHeader& stored, const StoreHeader& asked);

/// Throws InputError where there are `differences`; `file` is the store's, `remedy` what may be
/// done.
void refuse_differences(const std::string& file, const StoreHeader& stored,
                        const StoreHeader& asked, const std::string& remedy);

}  // namespace croon::experiments

#pragma once

namespace croon::experiments {

/// The exact two-sided p of McNemar's test (1947): of the pairs that one side alone won, each side
/// had either with equal chance, so the lesser number is binomial. 1 where there are none. Throws
/// std::logic_error where a number is negative.
double mcnemar_p(int only_base, int only_variant);

}  // namespace croon::experiments

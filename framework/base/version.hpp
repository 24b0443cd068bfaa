#pragma once

namespace croon {

/// The version of everything outside of stages that decides the result of a trial: the framework,
/// how starts are drawn, how trials are run. Raise it with a change by which the same experiment
/// gives other results; trials of two versions do not go into one store.
inline constexpr int kFrameworkVersion = 6;

}  // namespace croon

#pragma once

namespace croon {

/// The version of everything outside the stages that affects the result of a trial: the framework,
/// the drawing of starts, the execution of trials. Increment it with every change that alters the
/// results of the same experiment; a store never contains trials of two versions.
inline constexpr int kFrameworkVersion = 7;

}  // namespace croon

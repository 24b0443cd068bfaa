#pragma once

#include "framework/stage/stage_entry.hpp"

namespace croon::test {

/// A dataset "nested" without scenes, with every way in which a stage's parameters nest: a group
/// with presets, one without, a required one whose map holds objects with a group of their own.
StageEntry nested_stage();

}  // namespace croon::test

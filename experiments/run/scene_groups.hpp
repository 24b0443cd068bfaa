#pragma once

#include <string>
#include <vector>

#include "experiments/file/experiment.hpp"

namespace croon::experiments {

/// The scenes that trials calibrate from: `scenes` themselves if `scenes_per_trial` of the
/// experiment is 1. Else groups of so many of them, drawn from the experiment's seed and the number
/// of scenes alone, in the order of their first scenes. A group stands where a scene does (see
/// Scene::parts). No two groups share a scene, so their trials are independent; scenes that fill no
/// group are left out. The sensors of a group are those of all its scenes. The name of a group is
/// that of its first scene and the number of the others: "000003+4". The initial poses of
/// recordings may differ between scenes: a trial starts near that of the first. Throws InputError
/// if there are fewer scenes than a group has, or if the reference, or the true or nominal pose of
/// a sensor, differs between the scenes of a group, which then have no common rig.
std::vector<Scene> grouped(const Experiment& experiment, std::vector<Scene> scenes);

/// The scenes of all groups one by one; `scenes` if they are no groups.
std::vector<const Scene*> parts_of(const std::vector<Scene>& scenes);

/// The scenes of a group; the scene itself if it is none.
std::vector<const Scene*> parts_of(const Scene& scene);

}  // namespace croon::experiments

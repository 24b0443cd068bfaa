#pragma once

#include <string>

#include "framework/calibration/rig_view.hpp"
#include "framework/picture/drawing.hpp"

namespace croon::experiments {

/// The sensor of the view with this name; null if there is none.
const ViewedSensor* viewed_sensor(const RigView& view, const std::string& sensor);

/// Whether a refit moves the surfaces of the sensor by more than `kMaxSurfaceShift_m`.
bool is_contradicted(const ViewedSensor& sensor);

/// A sentence on the refit of a sensor, a warning if its clouds contradict the pose; empty without
/// a refit.
std::string fit_sentence(const ViewedSensor& sensor);

/// The residuals of a sensor over azimuth, elevation, range and incidence: in each bin the median
/// with a band between the quartiles. A sensor with a fault shows a slope or a wave.
Drawing residual_chart(const ViewedSensor& sensor, const Sheet& sheet = {});

/// The graph of sensors: a node per sensor, and an edge with overlap and median distance per pair
/// with overlap. Edges to rejected sensors are dashed.
Drawing sensor_graph(const RigView& view, const Sheet& sheet = {});

}  // namespace croon::experiments

#pragma once

#include <string>

#include "framework/calibration/rig_view.hpp"
#include "framework/picture/drawing.hpp"

namespace croon::experiments {

/// The residuals of a sensor over azimuth, elevation, range and incidence: in each bin the median
/// with a band between the quartiles. A sensor with a fault shows a slope or a wave.
Drawing residual_chart(const ViewedSensor& sensor, const Sheet& sheet = {});

/// The graph of sensors: a node per sensor, and an edge with overlap and median distance per pair
/// with overlap. Edges to rejected sensors are dashed.
Drawing sensor_graph(const RigView& view, const Sheet& sheet = {});

}  // namespace croon::experiments

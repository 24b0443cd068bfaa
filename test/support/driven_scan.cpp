#include "test/support/driven_scan.hpp"

namespace croon::test {

PointCloud driven_scan(const Points& world, const std::vector<double>& times_s, double reference_s,
                       const Twist& velocity, const RigidTransform& T_body_sensor) {
  PointCloud cloud;
  for (std::size_t i = 0; i < world.size(); ++i) {
    const RigidTransform T_reference_now =
        T_body_sensor.inverse() * motion_over(velocity, times_s[i] - reference_s) * T_body_sensor;
    cloud.points.push_back((T_reference_now.inverse() * world[i].cast<double>()).cast<float>());
  }
  cloud.channels = {make_channel(kTime, times_s)};
  return cloud;
}

}  // namespace croon::test

#pragma once

#include <vector>

#include "framework/geometry/pose_covariance.hpp"
#include "framework/registration/observability.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// The parameters of pose_uncertainty, which is based on the contacts between surfaces of two
/// clouds.
struct UncertaintyOptions {
  // Criteria and weights of contacts: as in the registration that computed the pose.
  double max_distance_m = 0.3;
  int normal_neighbours = 10;
  double direction_balance = 0.5;
  double kernel_width_m = 0.05;
  double surface_size_m = 8.0;  ///< Contacts of one direction in a cell of this edge are a surface.
  bool follows_contacts = true;        ///< Whether contacts change if the pose moves.
  double std_scale = 0.92;             ///< Of the jackknife; tuned on scenes with ground truth.
  double grazing_error_ratio = 0.075;  ///< Common error of grazed surfaces over the noise.
  /// The covariance of the target's velocity during the scans: about its axes in rad/s, along them
  /// in m/s. If it is not zero, both clouds need the channel time, with a common zero.
  Matrix6d motion_covariance = Matrix6d::Zero();
  /// The neighbours of a point form a line if the ratio of their spread across and along it is
  /// below this.
  double line_breadth_ratio = 0.14;
  double weak_ratio = kWeakRatio;
  double unobservable_ratio = kUnobservableRatio;
};

/// The uncertainty of the pose `T_target_source`, a minimum of Generalized-ICP, from the surfaces
/// on which the two clouds are in contact.
///
/// Errors of points on one surface are not independent, but errors of different surfaces are. So
/// contacts are grouped into surfaces k, each with its gradient g_k and its Hessian H_k of the
/// cost, and the covariance is the jackknife over surfaces: the sum of d_k d_k^T over the steps
/// `d_k = (H - H_k)^-1 g_k` of the pose when surface k is left out (Efron 1982; for dependent
/// observations the cluster jackknife, Bell and McCaffrey 2002). The Hessian includes the curvature
/// of the robust kernel (Huber 1981). If the pose moves, contacts change, and the cost rises less
/// than with constant contacts; this is measured by differences of gradients.
///
/// Surfaces seen at a grazing angle, more than 60 degrees off their normals, share an error: noise
/// along the rays makes them appear nearer or farther. It is a fraction of the noise, which is
/// 1.4826 times the median distance of contacts across their surfaces.
///
/// While the car drives, a point measured later by dt appears moved by -v dt; the resulting step of
/// the pose is known, so an uncertain velocity adds its variance along that step.
///
/// A degree of freedom is constrained if its information exceeds what noise of normals alone would
/// produce: both are computed from the two normals of a contact, which differ only by their noise.
/// That assumption fails where the neighbours of a point lie on a line no broader than the noise,
/// e.g. on distant ground, on one ring: there the noise determines the rotation of the normal about
/// the line, and because the rings of both clouds are parallel, both normals rotate alike. Such
/// contacts are ignored when classifying observability. Information is that of one degree of
/// freedom with all others free (the Schur complement), so it depends neither on units nor on other
/// directions.
PoseCovariance pose_uncertainty(const Cloud& target, const Cloud& source,
                                const RigidTransform& T_target_source,
                                const UncertaintyOptions& options);

}  // namespace croon

#pragma once

#include <vector>

#include "framework/geometry/pose_covariance.hpp"
#include "framework/registration/observability.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// How the uncertainty of a pose is estimated, from the surfaces on which two clouds touch.
struct UncertaintyOptions {
  // Which points touch, and how much they count: as in the registration that found the pose.
  double max_distance_m = 0.3;
  int normal_neighbours = 10;
  double direction_balance = 0.5;
  double kernel_width_m = 0.05;
  double surface_size_m = 8.0;  ///< Contacts of one direction in a cell of this edge are a surface.
  bool follows_contacts = true;  ///< Whether other points touch if the pose moves.
  double scale = 0.92;           ///< Of the jackknife over surfaces; found on scenes with truth.
  double grazing_error_ratio = 0.075;  ///< Of the noise: the error that grazed surfaces share.
  /// The covariance of what is not known of the target's velocity during the scans: about its axes
  /// in rad/s, along them in m/s. If it is not zero, both clouds need the channel time, with a
  /// common zero.
  Matrix6d motion_covariance = Matrix6d::Zero();
  /// The neighbours of a point lie on a line if they spread across it less than this times along
  /// it.
  double line_breadth_ratio = 0.14;
  double weak_ratio = kWeakRatio;
  double unobservable_ratio = kUnobservableRatio;
};

/// The uncertainty of the pose `T_target_source` that Generalized-ICP has found, or that it would
/// not move, by the surfaces on which the two clouds touch.
///
/// Errors of points on one surface are not independent, those of surfaces are. So contacts are
/// gathered into surfaces k, each with its gradient g_k and its Hessian H_k of the cost, and the
/// covariance is the jackknife over surfaces: the sum of d_k d_k^T of the steps
/// `d_k = (H - H_k)^-1 g_k` that the pose makes if surface k is left out (Efron 1982; for dependent
/// observations the cluster jackknife, Bell and McCaffrey 2002). The Hessian has the curvature of
/// the robust kernel (Huber 1981). Points touch others if the pose moves, and resist less than the
/// same contacts would; that is measured by differences of gradients.
///
/// Surfaces that are seen at a grazing angle, more than 60 degrees off their normals, share an
/// error: noise along the rays makes them appear nearer or farther. It is a share of the noise,
/// which is 1.4826 times the median distance of contacts across their surfaces.
///
/// While the car drives, a point that is measured later by dt appears moved by -v dt; the step that
/// the pose makes for it is known, so an unknown velocity adds its variance along that step.
///
/// A degree of freedom is held if the information about it is above what noise of normals pretends:
/// both follow from the two normals of a contact, which agree but for their noise. That is not so
/// where the neighbours of a point lie on a line that is no broader than the noise, as on ground
/// far off, on one ring: there the noise decides how the normal is turned about the line, and
/// because the rings of both clouds run alike, both normals are turned alike. Such contacts do not
/// count for the words. Information is that of one degree of freedom with all others free (the
/// Schur complement), so units and other directions do not matter.
PoseCovariance pose_uncertainty(const Cloud& target, const Cloud& source,
                                const RigidTransform& T_target_source,
                                const UncertaintyOptions& options);

}  // namespace croon

#pragma once

#include <functional>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. Rotations are matrices (3 x 3) or unit quaternions (w, x, y, z) as
// on slide 2:10. X_AB is the homogeneous transform (4 x 4) with p_A = X_AB p_B, the T of slide 2:11: it
// describes frame B relative to frame A. W is the world. Lengths are metres, angles radians. Slides are cited
// as chapter:number.

// Part 1, rotations (2:9, 2:10).

/// The rotation by `angle` about the unit vector `axis`: Rodrigues' formula.
Eigen::Matrix3d rotationMatrix(const Eigen::Vector3d& axis, double angle);

/// The way back: the vector axis * angle, of length 0 to pi. R is a rotation by any angle; also by 0, by pi,
/// and by angles very near to them. Within 1e-7 of pi either sign of the axis is right.
Eigen::Vector3d rotationVector(const Eigen::Matrix3d& R);

/// The quaternion of the rotation R(a) R(b): first b, then a. Slide 2:10, where the cross product has its
/// factors in the wrong order. q and -q are the same orientation, and either may be returned.
Eigen::Vector4d composed(const Eigen::Vector4d& a, const Eigen::Vector4d& b);

/// The unit quaternion on the way from orientation `a` (share = 0) to `b` (share = 1): a rotation about a
/// fixed axis, at constant speed, on the shorter way. Again, q or -q may be returned. b = a and b = -a occur,
/// but never half a turn (a^T b = 0). 0 <= share <= 1.
Eigen::Vector4d between(const Eigen::Vector4d& a, const Eigen::Vector4d& b, double share);

// Part 2, Euler angles (2:8). Three angles turn a frame: angles[0] about an axis of the world, then angles[1]
// and angles[2], each about an axis of the frame as the rotations before it left the frame.

enum class Convention {
  kYawPitchRoll,  ///< about z, then the new y, then the new x: 3-2-1. It locks at pitch = -pi/2 and pi/2.
  k313,           ///< about z, then the new x, then the new z. It locks at a second angle of 0 and pi.
};

/// The rotation of the frame; angles[0] turns first.
Eigen::Matrix3d eulerMatrix(Convention convention, const Eigen::Vector3d& angles);

/// The angles of a rotation. The second is in [-pi/2, pi/2] for kYawPitchRoll and in [0, pi] for k313, the
/// others are in [-pi, pi]. Where the convention locks, the third is 0. Entries of R may be wrong by 1e-15,
/// so 1 may be 1 + 2e-16. The angles lock up to these errors, or the second is at least 1e-3 away from it.
Eigen::Vector3d eulerAngles(Convention convention, const Eigen::Matrix3d& R);

/// A, whose column i is the axis about which the frame turns if only angle i grows: a unit vector in W. If
/// the angles change at the rates r, the angular velocity of the frame, in W, is A r.
Eigen::Matrix3d turningAxes(Convention convention, const Eigen::Vector3d& angles);

/// At angles where the convention locks: the axis about which no rates of the angles can turn the frame. A
/// unit vector in W, at right angles to every column of turningAxes(). Both signs are accepted.
Eigen::Vector3d lostAxis(Convention convention, const Eigen::Vector3d& angles);

// Part 3, transforms and chains (2:11 to 2:18).

/// X_BA. You may also use a general inverse, such as inverse() of course.h.
Eigen::Matrix4d inverted(const Eigen::Matrix4d& X_AB);

/// X_AB: frame B as seen from frame A, given the poses of both in the world.
Eigen::Matrix4d seenFrom(const Eigen::Matrix4d& X_WA, const Eigen::Matrix4d& X_WB);

enum class JointKind { kRevolute, kPrismatic };

/// A joint of a chain: it moves frame M relative to its own frame J by the coordinate q.
struct ChainJoint {
  Eigen::Matrix4d X_PJ =
      Eigen::Matrix4d::Identity();  ///< J relative to P: frame M of the joint before, W for the first
  JointKind kind = JointKind::kRevolute;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< unit vector, in J
};

/// At least one joint, and the frame E of the end in frame M of the last one.
struct Chain {
  std::vector<ChainJoint> joints;
  Eigen::Matrix4d X_ME = Eigen::Matrix4d::Identity();
};

/// X_JM of a joint alone: turned by q about its axis, or moved by q along it (2:16, where the axis is x).
Eigen::Matrix4d jointMotion(const ChainJoint& joint, double q);

/// X_WE, the pose of the end in the world, for the n coordinates q (2:15).
Eigen::Matrix4d endPose(const Chain& chain, const Eigen::VectorXd& q);

// Part 4, Jacobians (2:20 to 2:23), with one column for each joint.

/// The Jacobian (3 x n) of the world position of a point fixed in E, where p_E are its coordinates.
Eigen::MatrixXd pointJacobian(const Chain& chain, const Eigen::VectorXd& q, const Eigen::Vector3d& p_E);

/// The Jacobian (3 x n) of the world coordinates of a vector fixed in E, where v_E are its coordinates.
Eigen::MatrixXd vectorJacobian(const Chain& chain, const Eigen::VectorXd& q, const Eigen::Vector3d& v_E);

/// The Jacobian (d x n) of any f: R^n -> R^d at x by finite differences: each entry within 1e-7. f is smooth
/// everywhere; its values and derivatives up to the third are at most about 10 in size, and |x_i| <= 2.
Eigen::MatrixXd differences(const rex::VectorFunction& f, const Eigen::VectorXd& x);

/// The set of J qdot over all |qdot| = 1: an ellipsoid, described by its axes and half lengths.
struct Manipulability {
  Eigen::MatrixXd axes;   ///< d x d: unit vectors; column i belongs to radii[i], its sign is free
  Eigen::VectorXd radii;  ///< d half lengths, the longest first
  double measure = 0;     ///< sqrt(det(J J^T)): 0 in a singular posture
};

/// For J (d x n) with d <= n.
Manipulability manipulability(const Eigen::MatrixXd& J);

// Part 5, a bonus: the product of exponentials (Lynch and Park, Modern Robotics, 2017, chapters 3 and 4).

/// All points p of a body move at w x p + v, in W. Either |w| = 1, and v may have a part along w, though not
/// for a revolute joint; or w = 0 and |v| = 1, for a prismatic joint.
struct Screw {
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
};

/// The displacement of the body in W after time q, the coordinate of the joint in radians or metres.
Eigen::Matrix4d screwMotion(const Screw& screw, double q);

/// The screws of the joints in W, where all coordinates are 0.
std::vector<Screw> screwsOf(const Chain& chain);

/// X_WE from the screws and the pose X_WE0 of the end where all coordinates are 0.
Eigen::Matrix4d endPoseByScrews(const std::vector<Screw>& screws, const Eigen::Matrix4d& X_WE0,
                                const Eigen::VectorXd& q);

// Part 6, a bonus: a test.

/// Somebody's rotationMatrix().
using RotationFunction = std::function<Eigen::Matrix3d(const Eigen::Vector3d& axis, double angle)>;

/// Whether `candidate` is right: it returns what rotationMatrix() should, up to rounding errors of 1e-12, for
/// every unit vector and every angle from -pi to pi.
bool passesRotationTest(const RotationFunction& candidate);

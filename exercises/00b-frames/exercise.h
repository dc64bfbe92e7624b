#pragma once

#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. Rotations are matrices (3 x 3) or unit quaternions (w, x, y, z) as
// on slide 2:10. X_AB is the homogeneous transform (4 x 4) with p_A = X_AB p_B, the T of slide 2:11: it
// describes frame B relative to frame A. W is the world. Lengths are metres, angles radians. Slides are cited
// as chapter:number.

// Part 1, rotations (2:9, 2:10).

/// The rotation by `angle` about the unit vector `axis`: Rodrigues' formula.
Eigen::Matrix3d rotationMatrix(const Eigen::Vector3d& axis, double angle);

/// The way back: the w in the direction of the axis with |w| = angle, 0 <= |w| <= pi. At half a turn either
/// of the two directions will do. R is a rotation by any angle; also by 0, by pi, and by angles very near to
/// them.
Eigen::Vector3d rotationVector(const Eigen::Matrix3d& R);

/// The quaternion of the rotation R(a) R(b): first b, then a. Slide 2:10, where the cross product has its
/// factors in the wrong order. q and -q are the same orientation, and either may be returned.
Eigen::Vector4d composed(const Eigen::Vector4d& a, const Eigen::Vector4d& b);

/// The unit quaternion on the way from orientation `a` (share = 0) to `b` (share = 1): a rotation about a
/// fixed axis, at constant speed, on the shorter way. Again, q or -q may be returned. `a` and `b` may be
/// equal or opposite. They are never half a turn apart. 0 <= share <= 1.
Eigen::Vector4d between(const Eigen::Vector4d& a, const Eigen::Vector4d& b, double share);

// Part 2, Euler angles (2:8). Three angles turn a frame by three rotations in a row: about an axis of the
// world, then about an axis of the frame so turned, then about an axis of the frame turned twice.

enum class Convention {
  kYawPitchRoll,  ///< about z, then the new y, then the new x: 3-2-1. It locks at pitch = -pi/2 and pi/2.
  k313,           ///< about z, then the new x, then the new z. It locks at a second angle of 0 and pi.
};

/// The rotation of the frame, given the angles in the order in which they turn it.
Eigen::Matrix3d eulerMatrix(Convention convention, const Eigen::Vector3d& angles);

/// The angles of a rotation. The second is in [-pi/2, pi/2] for kYawPitchRoll and in [0, pi] for k313, the
/// others are in [-pi, pi]. Where the convention locks, the third is 0. R is a rotation up to rounding;
/// either it is locked, up to rounding, or the second angle is at least 1e-3 away from where it locks.
Eigen::Vector3d eulerAngles(Convention convention, const Eigen::Matrix3d& R);

/// The three axes about which the frame turns if one angle grows: unit vectors in world coordinates, as
/// columns in the order of the angles. If the angles change at the rates r, its angular velocity is A r with
/// this A.
Eigen::Matrix3d turningAxes(Convention convention, const Eigen::Vector3d& angles);

/// At angles where the convention locks: the axis about which no rates of the angles can turn the frame. A
/// unit vector in world coordinates, at right angles to every column of turningAxes(); of the two, either.
Eigen::Vector3d lostAxis(Convention convention, const Eigen::Vector3d& angles);

// Part 3, transforms and chains (2:11 to 2:18).

/// X_BA. Any way to compute it counts.
Eigen::Matrix4d inverted(const Eigen::Matrix4d& X_AB);

/// X_AB: frame B as seen from frame A, given the poses of both in the world.
Eigen::Matrix4d seenFrom(const Eigen::Matrix4d& X_WA, const Eigen::Matrix4d& X_WB);

enum class JointKind { kRevolute, kPrismatic };

/// A joint of a chain: it moves frame M relative to its own frame J by the coordinate q.
struct ChainJoint {
  Eigen::Matrix4d X_PJ =
      Eigen::Matrix4d::Identity();  ///< J in frame M of the joint before; in W for the first
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

/// Of the world position of the point that is fixed in E at p_E: 3 x n.
Eigen::MatrixXd pointJacobian(const Chain& chain, const Eigen::VectorXd& q, const Eigen::Vector3d& p_E);

/// Of the world direction of the vector that is fixed in E as v_E: 3 x n.
Eigen::MatrixXd vectorJacobian(const Chain& chain, const Eigen::VectorXd& q, const Eigen::Vector3d& v_E);

/// The Jacobian (d x n) of any f: R^n -> R^d at x by finite differences, within 1e-7 in every entry. Values
/// of f and its derivatives up to the third are at most about 10.
Eigen::MatrixXd differences(const rex::VectorFunction& f, const Eigen::VectorXd& x);

/// What all velocities of length one move: the end by J qdot with |qdot| = 1, an ellipsoid.
struct Manipulability {
  Eigen::MatrixXd axes;   ///< d x d: its axes, unit vectors as columns
  Eigen::VectorXd radii;  ///< d half lengths, the longest first
  double measure = 0;     ///< sqrt(det(J J^T)): 0 in a singular posture
};

/// For J (d x n) with d <= n.
Manipulability manipulability(const Eigen::MatrixXd& J);

// Part 5, a bonus: the product of exponentials (Lynch and Park, Modern Robotics, 2017, chapters 3 and 4).

/// A motion at speed one: all points p of a body move at w x p + v, in W. For a revolute joint w is a unit
/// vector, for a prismatic one it is zero.
struct Screw {
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
};

/// The transform by which the motion takes the body on in time q.
Eigen::Matrix4d screwMotion(const Screw& screw, double q);

/// The screws of the joints in W, where all coordinates are 0.
std::vector<Screw> screwsOf(const Chain& chain);

/// X_WE from the screws and the pose X_WE0 of the end where all coordinates are 0.
Eigen::Matrix4d endPoseByScrews(const std::vector<Screw>& screws, const Eigen::Matrix4d& X_WE0,
                                const Eigen::VectorXd& q);

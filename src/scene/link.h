#pragma once

namespace rex {

/// A joint's motion, or a part of it, in plain numbers for kernels. It leads from the pose of body `from`
/// to that of body `to`: X_W,to = X_W,from * X. The steps of a joint are consecutive, and all but the first
/// go from the body to itself. Poses are stored by columns as in rex::Pose: three of R, then p.
struct MotionStep {
  /// How X moves with x = ratio * q[qIndex] + offset:
  enum class Kind {
    kFixed,       ///< X = constant
    kHinge,       ///< X = constant + cos(x) first + sin(x) second
    kSlider,      ///< X = constant + x first
    kQuaternion,  ///< X = constant * R(q[qIndex] to q[qIndex + 3]) * first
  };
  static constexpr int kPoseSize = 12;

  Kind kind = Kind::kFixed;
  int from = 0, to = 0;
  int qIndex = 0;
  double ratio = 1, offset = 0;
  double constant[kPoseSize]{}, first[kPoseSize]{}, second[kPoseSize]{};
};

/// A moving part of the tree in plain numbers, for the kernels of dynamics. Each link has one coordinate, or
/// one quaternion, and includes all bodies fixed to it. A joint of several coordinates is a chain of links,
/// all but the last without mass. Parents come before children. Frame L of the link moves in that of its
/// parent P as
///   kHinge:       X_PL = constant * Rz(x)
///   kScrew:       X_PL = constant * Rz(x) * translation along z by pitch x
///   kSlider:      X_PL = constant * translation along z by x
///   kQuaternion:  X_PL = constant * R(q[qIndex] to q[qIndex + 3])
/// with x = ratio * q[qIndex] + offset. Its rate is ratio * v[vIndex]; that of a quaternion is the angular
/// velocity in L, v[vIndex] to v[vIndex + 2].
struct Link {
  enum class Kind { kHinge, kScrew, kSlider, kQuaternion };
  static constexpr int kNoParent = -1;  ///< its parent is the world

  Kind kind = Kind::kHinge;
  int parent = kNoParent;  ///< an index of Model::links()
  int body = 0;            ///< the child of the joint it belongs to
  int qIndex = 0, vIndex = 0;
  double ratio = 1, offset = 0;
  double pitch = 0;  ///< pitch of a screw, metres per radian

  double X_PL[12]{};    ///< the constant, stored by columns as rex::Pose
  double mass = 0;      ///< kg
  double moment[3]{};   ///< mass times centre of mass, in L, kg m
  double inertia[6]{};  ///< about L's origin, in L, kg m^2: xx, xy, xz, yy, yz, zz
  double armature = 0;  ///< added to the inertia that each entry of v meets: kg m^2, for a slider kg
  /// An upper bound of the inertia that its coordinate meets (kg m^2, for a slider kg) while sliders below
  /// stay within reach of their zero: a scale that separates a small inertia from none.
  double largestInertia = 0;
};

}  // namespace rex

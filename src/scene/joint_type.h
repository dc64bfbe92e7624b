#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include <Eigen/Core>

#include "geometry/pose.h"
#include "scene/motion_step.h"

namespace rex {

/// The motions a joint allows, from joint frame F to moved frame M. Coordinates in the order q lists them:
/// hinge, slider: angle about or way along `axis`; screw: angle about `axis`, along which it moves by `pitch`
/// per turn; cylindrical: angle about `axis`, then way along it; planarXY, translation3: moves along x, y (,
/// z) of F; planarXYPhi: x, y, then turn about z; planarPhiXY: turn about z first, then x, y of the turned
/// frame; universal: turn about x, then y; ball: unit quaternion w x y z; free: x y z, then quaternion;
/// rigid: none. All that is known of a type stands in one row of joint_type.cpp.
enum class JointType {
  kRigid,
  kHinge,
  kSlider,
  kScrew,
  kCylindrical,
  kPlanarXY,
  kTranslation3,
  kPlanarXYPhi,
  kPlanarPhiXY,
  kUniversal,
  kBall,
  kFree
};

/// "hinge", "slider", "planarXY", ...
[[nodiscard]] std::string_view toString(JointType type);

/// The word for the type in .ors files, without the letter of its axis that hinges and sliders append.
[[nodiscard]] std::string_view orsWord(JointType type);

/// The word for the type in URDF files; empty if URDF has no such joint.
[[nodiscard]] std::string_view urdfWord(JointType type);

/// Number of position coordinates and of velocities of a joint type; they differ only for quaternions.
[[nodiscard]] int positionCount(JointType type);
[[nodiscard]] int velocityCount(JointType type);

/// Whether joints of the type turn about or move along an axis of their own.
[[nodiscard]] bool hasAxis(JointType type);

/// One of the movements that a joint type does one after the other.
struct JointMovement {
  using Kind = MotionStep::Kind;

  Kind kind = Kind::kFixed;
  int coordinate = 0;                              ///< its first one, of the joint's, in q as in v
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< how far a slider goes per unit; unit for hinges
  bool isRise = false;                             ///< of a screw: a slider with the coordinate of its turn
  std::string_view part{};                         ///< appended to the joint's name for this movement alone
};

/// The movements of a joint: frame F comes before the first, M after the last. A rigid joint has one that is
/// fixed.
class JointMovements {
 public:
  void append(const JointMovement& movement) { all_[size_++] = movement; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const JointMovement& operator[](std::size_t i) const { return all_[i]; }
  [[nodiscard]] const JointMovement* begin() const { return all_.data(); }
  [[nodiscard]] const JointMovement* end() const { return all_.data() + size_; }

 private:
  std::array<JointMovement, 4> all_{};
  std::size_t size_ = 0;
};

/// Axis is a unit vector, if the type has one; pitch is a screw's, in metres per turn.
[[nodiscard]] JointMovements movements(JointType type, const Eigen::Vector3d& axis, double pitch);

/// How a joint looks from its child: of which type it is there, in frames turned by X_FC, and for each
/// coordinate which of the old ones it is, with which sign. Joints with an axis keep their coordinates, about
/// the opposite axis; those of a free joint depend on each other: both have `count` 0.
struct JointReversal {
  struct Coordinate {
    int from = 0;
    int sign = 0;
  };
  JointType type{};
  Pose X_FC{};
  std::array<Coordinate, 4> coordinates{};
  int count = 0;
};
[[nodiscard]] JointReversal reversalOf(JointType type);

/// X_FM(q), the motion of a joint. q has positionCount(type) entries; a quaternion is normalised on use.
[[nodiscard]] Pose jointMotion(JointType type, const Eigen::Vector3d& axis, double pitch, const double* q);

/// The coordinates whose motion comes nearest to X_FM: exact when X_FM is a motion of this joint, else the
/// part that is (of a hinge or screw the signed turn about its axis in (-pi, pi]).
[[nodiscard]] Eigen::VectorXd jointCoordinates(JointType type, const Eigen::Vector3d& axis, const Pose& X_FM);

}  // namespace rex

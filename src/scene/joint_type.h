#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include <Eigen/Core>

#include "geometry/pose.h"
#include "scene/link.h"

namespace rex {

/// The motions a joint allows, from joint frame F to moved frame M. Coordinates in their order in q: hinge,
/// slider: angle about or displacement along `axis`; screw: angle about `axis`, along which it moves by
/// `pitch` per turn; cylindrical: angle about `axis`, then displacement along it; planarXY, translation3:
/// displacements along x, y (, z) of F; planarXYPhi: x, y, then angle about z; planarPhiXY: angle about z
/// first, then x, y of the turned frame; universal: angle about x, then y; ball: unit quaternion w x y z;
/// free: x y z, then quaternion; rigid: none. Each type is defined by one row of joint_type.cpp.
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

/// Whether joints of the type turn about, or move along, an axis that each joint chooses.
[[nodiscard]] bool hasAxis(JointType type);

/// One of the elementary movements that make up the motion of a joint, one after the other.
struct JointMovement {
  using Kind = MotionStep::Kind;

  Kind kind = Kind::kFixed;
  int coordinate = 0;             ///< index of its first one among those of the joint
  Eigen::Vector3d axis{0, 0, 0};  ///< hinge: unit vector; slider: displacement per unit
  bool isRise = false;            ///< whether it is the slider of a screw
  std::string_view part{};        ///< appended to the joint's name for this movement alone
};

/// The movements of a joint, from frame F before the first to M after the last. A rigid joint has one that
/// is fixed.
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

/// `axis` is a unit vector, used if the type has one; `pitch` is that of a screw, in metres per turn.
[[nodiscard]] JointMovements movements(JointType type, const Eigen::Vector3d& axis, double pitch);

/// A joint with parent and child exchanged: its type then, in frames turned by X_FC, and for each
/// coordinate the index of the old one and its sign. `count` is 0 for joints with an axis, which keep their
/// coordinates about the opposite axis, and for free joints, whose coordinates depend on each other.
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

/// The coordinates whose motion comes nearest to X_FM. They are exact if X_FM is a motion of this joint;
/// otherwise they give the part that is: for a hinge or screw, the angle about its axis in (-pi, pi].
[[nodiscard]] Eigen::VectorXd jointCoordinates(JointType type, const Eigen::Vector3d& axis, const Pose& X_FM);

}  // namespace rex

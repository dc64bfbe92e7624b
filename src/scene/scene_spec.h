#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/error.h"
#include "geometry/pose.h"
#include "geometry/shape.h"

namespace rex {

/// The motions a joint allows, from joint frame F to moved frame M. Coordinates in the order q lists them:
/// hinge, slider: angle about or way along `axis`; planarXY, translation3: moves along x, y (, z) of F;
/// planarXYPhi: x, y, then turn about z; planarPhiXY: turn about z first, then x, y of the turned frame;
/// universal: turn about x, then y; ball: unit quaternion w x y z; free: x y z, then quaternion; rigid: none.
enum class JointType {
  kRigid,
  kHinge,
  kSlider,
  kPlanarXY,
  kTranslation3,
  kPlanarXYPhi,
  kPlanarPhiXY,
  kUniversal,
  kBall,
  kFree
};

/// Number of position coordinates and of velocities of a joint type; they differ only for quaternions.
[[nodiscard]] int positionCount(JointType type);
[[nodiscard]] int velocityCount(JointType type);

enum class BodyKind { kDynamic, kKinematic, kStatic };

/// A shape on a body (or in the world); X_BS is its pose in the body's frame.
struct ShapeSpec {
  std::string name;
  Pose X_BS;
  Shape shape;
  Eigen::Vector4d color{0.8, 0.8, 0.8, 1};  ///< red, green, blue, opacity, each 0..1
  bool contact = false;                     ///< takes part in collision detection
  std::string meshFile{};                   ///< what `shape.mesh` is read from, see loadMeshes()
  double meshScale = 1;
  SourceLocation where{};
};

/// A rigid body. X_WB counts only for roots: a body moved by a joint stands where the joint puts it.
struct BodySpec {
  std::string name;
  Pose X_WB;
  double mass = 0;                                   ///< kg; 0: massless
  Eigen::Vector3d p_BBcm = Eigen::Vector3d::Zero();  ///< centre of mass in B, metres
  std::optional<Eigen::Matrix3d> inertia{};  ///< about the centre of mass, in B, kg m^2; unset: 0.2 m Id
  BodyKind kind = BodyKind::kDynamic;
  std::vector<ShapeSpec> shapes{};
  SourceLocation where{};
};

/// A joint: X_W,child = X_W,parent * X_PF * X_FM(q) * X_MC. Parent and child name the first body of that
/// name.
struct JointSpec {
  std::string name;
  std::string parent, child;
  JointType type = JointType::kHinge;
  Pose X_PF, X_MC;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< of a hinge or slider, in F; any length but zero
  Eigen::VectorXd q0{};                             ///< initial coordinates; empty: the zero position
  Eigen::VectorXd lower{}, upper{};                 ///< limits of each coordinate; empty: none
  std::string mimic{};  ///< a joint whose coordinates this one shares; empty: its own
  SourceLocation where{};
};

/// A scene as it is read and edited. Bodies keep file order; compile() turns it into a Model.
struct SceneSpec {
  std::string name;  ///< for messages: the file name
  std::vector<BodySpec> bodies;
  std::vector<JointSpec> joints;
  std::vector<ShapeSpec> worldShapes;
};

/// X_FM(q), the motion of a joint. q has positionCount(type) entries; a quaternion is normalised on use.
[[nodiscard]] Pose jointMotion(JointType type, const Eigen::Vector3d& axis, const double* q);

/// The coordinates whose motion comes nearest to X_FM: exact when X_FM is a motion of this joint, else the
/// part that is (of a hinge the signed turn about its axis in (-pi, pi]).
[[nodiscard]] Eigen::VectorXd jointCoordinates(JointType type, const Eigen::Vector3d& axis, const Pose& X_FM);

}  // namespace rex

#pragma once

#include <vector>

#include "kinematics/forward_kinematics.h"

namespace rex::internal {

/// Finds pairs of bodies that joints carry which follow one another so that their relative pose never
/// changes: two sliders that run the same way, or a hinge that turns another back about the same line.
class CoupledMotion {
 public:
  explicit CoupledMotion(const Model& model);

  /// Whether the relative pose of two bodies provably does not depend on q, because the exponentials of the
  /// joints between them cancel (as products of exponentials, Brockett 1984): those of one coordinate merge
  /// where they commute with each other and with all between. Sure up to rounding, and "no" where in doubt:
  /// of ball and free joints, and of longer loops that close without commuting.
  [[nodiscard]] bool cancels(BodyId a, BodyId b) const;

 private:
  struct Twist {
    int coordinate;  // a place in q
    Eigen::Vector3d angular, linear;
    bool isPlain;  // not of a quaternion
  };
  void addTwists(const Joint& joint);
  static bool commute(const Twist& one, const Twist& other);
  static bool isZero(const Twist& twist);
  [[nodiscard]] std::vector<Twist> twistsBetween(BodyId a, BodyId b) const;
  static bool mergeOnce(std::vector<Twist>& twists);

  const Model& model_;
  BodyPoses poses_;                         // in the posture of reference
  std::vector<std::vector<Twist>> twists_;  // of each joint, seen from the world in that posture
  bool isCoupled_ = false;
};

}  // namespace rex::internal

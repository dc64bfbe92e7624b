#pragma once

#include <functional>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "collision/contacts.h"
#include "kinematics/forward_kinematics.h"

namespace rex::internal {

/// Which bodies are fixed to each other, and which of these parts a joint or a pin links.
class RigidParts {
 public:
  explicit RigidParts(const Model& model);

  /// The body that carries all that is fixed to each other; of what is fixed in the world, the world.
  [[nodiscard]] BodyId part(BodyId body) const { return parts_[static_cast<std::size_t>(body)]; }
  /// The last free joint on the way from the world to a body; kNoJoint without one.
  [[nodiscard]] JointId freeJoint(BodyId body) const { return freeJoints_[static_cast<std::size_t>(body)]; }
  /// Whether a pin links them, or what is fixed to them.
  [[nodiscard]] bool arePinned(BodyId a, BodyId b) const;
  /// As pairVerdicts() says of kAllButNeighbours.
  [[nodiscard]] bool areNeighbours(BodyId a, BodyId b) const;

 private:
  /// The part of a body, or the body itself if it is fixed in the world.
  [[nodiscard]] BodyId node(BodyId body) const { return part(body) == kWorld ? body : part(body); }
  /// The neighbour of a part towards the world, which is another part or a body that is fixed in the world,
  /// and who is pinned to whom.
  void findNeighbours(const Model& model);

  std::vector<BodyId> parts_;
  std::vector<JointId> freeJoints_;
  std::vector<std::optional<BodyId>> above_;  // of each body that carries a part
  std::set<std::pair<BodyId, BodyId>> pinned_;
};

/// Whether a joint holds its bodies in one place: a rigid one, or one that follows another at the ratio 0.
[[nodiscard]] bool isFixed(const Joint& joint);

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

/// Two shapes that overlap in the initial posture, how deep there, metres, and in the middle of all limits.
struct HomeOverlap {
  ShapePair pair;
  double depth = 0;
};

/// All that are deeper than `tolerance`, of shapes that `isAsked` for, sorted by their shapes. A mesh that is
/// not loaded overlaps nothing.
[[nodiscard]] std::vector<HomeOverlap> homeOverlaps(
    const Model& model, double tolerance,
    const std::function<bool(const ModelShape&, const ModelShape&)>& isAsked);

/// Whether a shape takes part in collisions.
[[nodiscard]] inline bool takesPart(const ModelShape& shape) {
  return shape.contact && shape.shape.type != ShapeType::kMarker;
}

}  // namespace rex::internal

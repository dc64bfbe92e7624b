#pragma once

#include <optional>
#include <set>
#include <utility>
#include <vector>

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

}  // namespace rex::internal

#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <Eigen/Core>

#include "physics/pin_rows_internal.h"
#include "scene/model.h"

namespace rex::internal {

/// A link of one coordinate: where a hinge or slider of the model is in Bullet.
struct CoordinatePlace {
  btMultiBody* body = nullptr;
  int link = 0;

  /// Where it stands in Bullet's vectors of velocities, after the six of the base.
  [[nodiscard]] int velocityIndex() const { return 6 + body->getLink(link).m_dofOffset; }
};

/// A link whose coordinate is ratio * leader + offset, because its joint mimics another or is a screw.
struct Follower {
  CoordinatePlace at, leader;
  double ratio = 1, offset = 0;
  JointId joint = kNoJoint;
};

/// Keeps a follower to its leader.
class CouplingRow : public HeldRows {
 public:
  explicit CouplingRow(const Follower& follower);

  [[nodiscard]] const Follower& follower() const { return follower_; }
  [[nodiscard]] double wanted(int row) const override;
  void finalizeMultiDof() override;
  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override;

 private:
  Follower follower_;
};

/// All that follows in a world, and all pins. Bullet gives each follower a coordinate of its own; the rows of
/// its solver couple them to contacts and motors, and settle() makes them exact afterwards, by the impulses
/// that all couplings and pins of some trees need together. So motion without contact is that of the model
/// with its fewer coordinates and its closed loops, and errors do not add up.
class Couplings {
 public:
  using Pins = std::vector<std::pair<PinEnd, PinEnd>>;
  /// The body of the first end of each pin moves.
  Couplings(const std::vector<Follower>& followers, const Pins& pins);

  void addTo(btMultiBodyDynamicsWorld& world);
  void removeFrom(btMultiBodyDynamicsWorld& world);
  /// Forgets the impulses of the last step.
  void forget();
  /// What the velocities along the rows are to become: zero, or what reduces errors of positions, too.
  enum class Aim { kHold, kReduceErrors };
  /// Changes the velocities, before positions move on.
  void settle(Aim aim = Aim::kReduceErrors);
  /// Calls visit(body) for all that is coupled; for some more than once.
  template <class Visit>
  void forEachBody(const Visit& visit) const {
    for (const Group& group : groups_)
      for (btMultiBody* const body : group.bodies) visit(*body);
  }
  /// The joint of a follower or leader that Bullet cannot move, for there is no mass behind it, if any. Of
  /// bodies as they are placed; changes velocities.
  [[nodiscard]] JointId massless(const Model& model);

 private:
  // What is coupled, directly or not, and how its bodies answer to a unit impulse of each row.
  struct Group {
    std::vector<HeldRows*> held;
    std::vector<btMultiBody*> bodies;
    bool hasPins = false;
  };
  void join(HeldRows* rows);
  void settle(Group& group, Aim aim);
  [[nodiscard]] bool isStuck(const CoordinatePlace& place);

  std::vector<std::unique_ptr<CouplingRow>> followers_;
  std::vector<std::unique_ptr<PinRows>> pins_;
  std::vector<Group> groups_;
  std::vector<std::vector<btScalar>> answers_;  // of a group: row by row, body by body
  std::vector<btScalar> force_;
  btAlignedObjectArray<btScalar> scratchR_;
  btAlignedObjectArray<btVector3> scratchV_;
};

}  // namespace rex::internal

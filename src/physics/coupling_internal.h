#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "scene/model.h"

namespace rex::internal {

/// The coordinates of a body in Bullet, the six of the base included.
inline int velocityCount(const btMultiBody& body) { return 6 + body.getNumDofs(); }

/// Rows that hold two links to each other. Those that a CoupledBody holds are no rows of Bullet's solver;
/// others are solved along with the contacts. Couplings then makes them exact. If both links are in one body,
/// the Jacobian of A holds everything: Bullet adds the terms of A and B on their own, but not the coupling
/// between them.
class LockedRows : public btMultiBodyConstraint {
 public:
  using btMultiBodyConstraint::btMultiBodyConstraint;

  [[nodiscard]] bool isInOneBody() const { return m_bodyA == m_bodyB; }
  /// The coefficients of a row for the velocities of a body; null if it has none.
  [[nodiscard]] const double* coefficients(int row, const btMultiBody& body) {
    if (&body == m_bodyA) return jacobianA(row);
    return &body == m_bodyB ? jacobianB(row) : nullptr;
  }
  /// Finds the coefficients in the present posture.
  virtual void measure() = 0;
  /// The velocity along a row that reduces its error, in the posture that was measured last.
  [[nodiscard]] virtual double wanted(int row) const = 0;
  /// From now on, a CoupledBody holds them.
  void leaveSolver() { isInSolver_ = false; }

  /// Forgets the impulses of the last step.
  void forget() {
    for (int i = 0; i < getNumRows(); ++i) internalSetAppliedImpulse(i, 0);
  }

  int getIslandIdA() const override;
  int getIslandIdB() const override;
  void debugDraw(btIDebugDraw*) override {}
  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override;

 protected:
  /// The velocity along a row that the solver is to aim at.
  [[nodiscard]] virtual double wantedOfSolver(int row) const { return wanted(row); }

 private:
  void addRow(int i, btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
              const btContactSolverInfo& info);

  bool isInSolver_ = true;
};

/// A point of a pin in Bullet: fixed in a link (-1: the base) of a body, or, without one, in W.
struct PinEnd {
  btMultiBody* body = nullptr;
  int link = -1;
  btVector3 point{0, 0, 0};

  [[nodiscard]] btVector3 inWorld() const { return body ? body->localPosToWorld(link, point) : point; }
};

/// Keeps two points together: a row for each axis of W.
class PinRows : public LockedRows {
 public:
  /// The body of A moves.
  PinRows(const PinEnd& A, const PinEnd& B);

  [[nodiscard]] double wanted(int row) const override;
  void measure() override;
  void finalizeMultiDof() override { allocateJacobiansMultiDof(); }

 private:
  // Adds the velocity of an end along the axis, times `sign`, to the coefficients of its body.
  void addSpeed(const PinEnd& end, const btVector3& axis, double sign, double* coefficients);

  PinEnd A_, B_;
  btVector3 gap_{0, 0, 0};
  btAlignedObjectArray<btScalar> one_, scratchR_;
  btAlignedObjectArray<btVector3> scratchV_;
  btAlignedObjectArray<btMatrix3x3> scratchM_;
};

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
class CouplingRow : public LockedRows {
 public:
  explicit CouplingRow(const Follower& follower);

  [[nodiscard]] const Follower& follower() const { return follower_; }
  [[nodiscard]] double wanted(int row) const override;
  void measure() override {}
  void finalizeMultiDof() override;

 private:
  // Without the error, which settle() lets fade.
  [[nodiscard]] double wantedOfSolver(int) const override { return 0; }

  Follower follower_;
};

/// A body that couplings and pins hold without any other body. In each step its velocities fit all their rows
/// G from the start, and so does the answer of the body to every impulse: M^-1 J^T - W (G W)^-1 G M^-1 J^T
/// with W = M^-1 G^T. So contacts, motors and limits are solved together with what holds the body.
class CoupledBody {
 public:
  CoupledBody(btMultiBody& body, std::vector<LockedRows*> held, bool hasPins);

  /// Once in a step, when Bullet has accelerated the body freely: as it would have with what holds it.
  void begin();
  /// Lets begin() work again.
  void end() { isBegun_ = false; }
  /// Makes the answer of the body with what holds it of the one without.
  void correct(Eigen::Ref<Eigen::VectorXd> answer) const;

 private:
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& missing) const;

  btMultiBody& body_;
  std::vector<LockedRows*> held_;
  bool hasPins_, isBegun_ = false;
  Eigen::MatrixXd Gt_, W_;
  Eigen::VectorXd scale_, wanted_;
  Eigen::LLT<Eigen::MatrixXd> llt_;
  btAlignedObjectArray<btScalar> scratchR_;
  btAlignedObjectArray<btVector3> scratchV_;
};

/// All that follows in a world, and all pins. Bullet gives each follower a coordinate of its own; a
/// CoupledBody or, between several bodies, rows of its solver couple them to contacts and motors, and
/// settle() makes them exact afterwards, by the impulses that all couplings and pins of some trees need
/// together. So motion without contact is that of the model with its fewer coordinates and its closed loops,
/// and errors do not add up.
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
  /// What holds a body alone, or null.
  [[nodiscard]] CoupledBody* coupled(const btMultiBody& body);
  /// The joint of a follower or leader that Bullet cannot move, for there is no mass behind it, if any. Of
  /// bodies as they are placed; changes velocities.
  [[nodiscard]] JointId massless(const Model& model);

 private:
  // What is coupled, directly or not, and how its bodies answer to a unit impulse of each row.
  struct Group {
    std::vector<LockedRows*> held;
    std::vector<btMultiBody*> bodies;
    bool hasPins = false;
    std::unique_ptr<CoupledBody> alone{};  // if there is only one body
  };
  void join(LockedRows* rows);
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

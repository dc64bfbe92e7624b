#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace rex::internal {

/// What armatures add to the inertia M of a multibody, which knows of none, J^T A J, and what springs too
/// stiff for the step resist, J^T S J, where each row of J takes the velocities of the body in Bullet to one
/// that has an armature or a spring. By Woodbury's formula, (M + J^T (A + S) J)^-1 f = y - G ((A + S)^-1 + J
/// G)^-1 J y with y = M^-1 f and G = M^-1 J^T. As rows of Bullet's solver, stiff springs of several joints
/// would need more iterations than a step has.
class Armature {
 public:
  /// For so many rows. The body finds it by its user pointer, and must not outlive it.
  Armature(btMultiBody& body, int rows);

  void setInertia(int row, double inertia) { inertia_[row] = inertia; }
  /// What the row resists in the next step: the impulse per unit of its velocity at the end.
  void setResistance(int row, double resistance) { resistance_[row] = resistance; }
  /// The inertia that the row met in the last step, without armature: kg m^2 or kg; 0 in the first.
  [[nodiscard]] double met(int row) const { return met_[row]; }
  /// Forgets the last step.
  void forget() { met_.setZero(); }
  /// The row is Bullet's velocity of that index.
  void measure(int row, int velocity) { Jt_(velocity, row) = 1; }
  /// The row is angular * omega + linear * v, of the origin of the base; while Bullet's velocities stay the
  /// same, it changes by `drift` in the next step.
  void measureBase(int row, const Eigen::Vector3d& angular, const Eigen::Vector3d& linear, double drift);

  /// Begins a step: the velocities are those before it.
  void begin();
  /// Once in a step, when Bullet has accelerated the body without armature: as it would have with it.
  void slowDown();
  /// Makes the answer of the body with armature of the one without.
  void correct(Eigen::Ref<Eigen::VectorXd> answer) const;

  /// That of a body, or null.
  [[nodiscard]] static Armature* of(const btMultiBody& body) {
    return static_cast<Armature*>(body.getUserPointer());
  }

 private:
  btMultiBody& body_;
  Eigen::MatrixXd Jt_, G_;
  Eigen::VectorXd inertia_, resistance_, met_, drift_, before_;
  Eigen::LLT<Eigen::MatrixXd> llt_;
  bool isBegun_ = false;
  btAlignedObjectArray<btScalar> scratchR_;
  btAlignedObjectArray<btVector3> scratchV_;
};

/// The velocities that a unit impulse adds: as Bullet's function, with armature.
void answerOf(const btMultiBody& body, const btScalar* impulse, btScalar* answer,
              btAlignedObjectArray<btScalar>& scratchR, btAlignedObjectArray<btVector3>& scratchV);

class Couplings;

/// Bullet's solver for bodies with armature, and for those that couplings hold: all rows, those of contacts
/// too, meet the inertia of both, and move what follows.
class ArmatureSolver : public btMultiBodyConstraintSolver {
 public:
  /// What holds bodies; it must outlive the steps.
  void use(Couplings* couplings) { couplings_ = couplings; }

 protected:
  btScalar solveGroupCacheFriendlySetup(btCollisionObject** bodies, int bodyCount,
                                        btPersistentManifold** manifolds, int manifoldCount,
                                        btTypedConstraint** constraints, int constraintCount,
                                        const btContactSolverInfo& info, btIDebugDraw* debug) override;

 private:
  void correct(btMultiBodySolverConstraint& row);
  double correctSide(const btMultiBody& body, int jacobian, int velocities, double impulse);

  Couplings* couplings_ = nullptr;
  Eigen::VectorXd change_;
};

}  // namespace rex::internal

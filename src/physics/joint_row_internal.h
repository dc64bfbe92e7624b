#pragma once

#include <limits>

#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>

namespace rex::internal {

/// Constraints on one velocity of a joint, all solved along with the contacts: motor, limits, friction,
/// damping.
class JointRow : public btMultiBodyConstraint {
 public:
  /// Wants the velocity to be `velocity`, with impulses within bounds. It yields by `softness` times the
  /// impulse.
  struct Goal {
    double velocity = 0;
    double lowest = 0, highest = 0;  ///< impulse: N s, or N m s
    double softness = 0;
  };

  /// Of the freedom `place` of a link; both count from 0.
  JointRow(btMultiBody& body, int link, int place);

  void clear() { count_ = 0; }
  void add(const Goal& goal) { goals_[count_++] = goal; }

  void finalizeMultiDof() override;
  int getIslandIdA() const override;
  int getIslandIdB() const override { return getIslandIdA(); }
  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override;
  void debugDraw(btIDebugDraw*) override {}

 private:
  static constexpr int kMostGoals = 5;
  int place_;
  int count_ = 0;
  Goal goals_[kMostGoals];
};

}  // namespace rex::internal

#pragma once

#include <array>
#include <optional>

#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>

namespace rex::internal {

/// Limits become active within this distance, radians or metres, or within twice the motion of a step.
inline constexpr double kLimitReach = 0.01;

/// Constraints on one velocity of a joint or of a base that is free, all solved along with the contacts:
/// motor, limits, friction, damping.
class JointRow : public btMultiBodyConstraint {
 public:
  /// Wants the velocity to be `velocity`, with impulses within bounds. It yields by `softness` times the
  /// impulse.
  struct Goal {
    double velocity = 0;
    double lowest = 0, highest = 0;  ///< impulse: N s, or N m s
    double softness = 0;
  };

  enum Purpose { kMotor, kDamping, kFriction, kLowerLimit, kUpperLimit, kPurposes };

  /// Of the freedom `place` of a link; both count from 0.
  JointRow(btMultiBody& body, int link, int place);
  /// Of a base; measureBase() says which velocity.
  explicit JointRow(btMultiBody& body);

  /// The velocity is angular * omega + linear * v, of the origin of the base; all in W.
  void measureBase(const btVector3& angular, const btVector3& linear);

  /// Forgets the goals, or also the impulses of the last step, from which the solver starts
  /// otherwise.
  void clearGoals() { goals_.fill(std::nullopt); }
  void forget();
  void set(Purpose purpose, const Goal& goal) { goals_[purpose] = goal; }

  void finalizeMultiDof() override;
  int getIslandIdA() const override;
  int getIslandIdB() const override { return getIslandIdA(); }
  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override;
  void debugDraw(btIDebugDraw*) override {}

 private:
  int place_ = 0;
  std::array<std::optional<Goal>, kPurposes> goals_;
};

}  // namespace rex::internal

#pragma once

#include <array>
#include <optional>

#include "locomotion/whole_body_control.h"
#include "locomotion/zero_moment_point.h"

namespace rex {

struct WalkControlOptions {
  PreviewOptions preview{.height = 0.8, .step = 0.01};  ///< as in WalkOptions
  double lift = 0.05;                                   ///< height to which a foot is lifted, metres
  double captureGain = 4;    ///< how fast errors of the capture point should decay, 1/s
  bool adjustsSteps = true;  ///< whether a foot may land elsewhere than planned
  WholeBodyOptions body{};
};

/// The vertical forces that a robot's feet measure, N.
struct FootLoads {
  double left = 0, right = 0;
};

/// What the controller does at one time.
struct WalkControl {
  WholeBodyForces forces{};
  Eigen::Vector2d plannedZmp =
      Eigen::Vector2d::Zero();         ///< that of the plan, displaced with its steps; metres
  Eigen::Vector2d zmp{0, 0};           ///< demanded, within the soles that stand
  Eigen::Vector2d captureError{0, 0};  ///< capture point minus that of the plan
  Eigen::Vector2d displacement{0, 0};  ///< of all steps to come, from adjusted steps
  std::optional<Footstep> landing{};   ///< where the foot in the air is to land
};

/// Lets a robot walk as planned where the ground is not as planned and the robot is pushed. The plan's motion
/// of the centre of mass is that of followZmp(). A deviation of the capture point is answered by the zero
/// moment point, p = p_ref + (1 + k / omega) (xi - xi_ref), within the soles (Englsberger et al. 2011,
/// Bipedal walking control based on capture point dynamics); where that does not suffice, by landing the foot
/// elsewhere and displacing the rest of the plan by as much. WholeBodyControl turns the wanted accelerations
/// into joint forces. The robot knows its state and the loads of its feet, not the height of the ground.
class WalkController {
 public:
  /// `home` (nq): the posture that arms, waist and neck keep. Throws Error like duration(), followZmp() and
  /// WholeBodyControl, for a home of the wrong size, and options that are not positive.
  WalkController(const Model& model, const Legs& legs, const WalkPlan& plan, const VectorArg& home,
                 const WalkControlOptions& options = {});

  /// The joint forces at state.time, seconds since the plan began; times may only grow. Throws Error like
  /// WholeBodyControl::forces() and phaseAt().
  [[nodiscard]] WalkControl control(const State& state, const FootLoads& loads);

 private:
  struct Foot {
    Side side = Side::kLeft;
    bool swings = false, stands = true;
    Eigen::Vector3d lifted{0, 0, 0};  // where it really left the ground minus where planned
    Pose X_WS{};
    Vector6d velocity = Vector6d::Zero();
  };

  void update(const State& state, const FootLoads& loads, const WalkPhase& phase);
  void follow(const State& state, WalkControl& now) const;
  void adjustStep(const WalkPhase& phase, const Eigen::Vector2d& captureError);
  [[nodiscard]] Eigen::Vector2d withinSoles(const Eigen::Vector2d& p) const;
  [[nodiscard]] Eigen::Vector3d swingPlace(const Foot& foot, double t) const;
  [[nodiscard]] FootGoal footGoal(const Foot& foot, const WalkPhase& phase, double t) const;
  [[nodiscard]] WholeBodyGoal goalAt(const State& state, const WalkPhase& phase,
                                     const Eigen::Vector2d& zmp) const;

  Model model_;
  Legs legs_;
  WalkPlan plan_;
  Eigen::VectorXd home_{};
  WalkControlOptions options_;
  WholeBodyControl body_;
  PreviewMotion motion_;
  InvertedPendulum pendulum_{};
  std::vector<bool> isLeg_{};  // of each coordinate in v
  std::array<Foot, 2> feet_{};
  BodyPoses poses_{};
  Eigen::Vector2d displacement_{0, 0}, adjustment_{0, 0};
  std::vector<int> active_{};
};

}  // namespace rex

#pragma once

#include "kinematics/forward_kinematics.h"
#include "locomotion/footsteps.h"
#include "locomotion/preview_control.h"

namespace rex {

/// What of a robot walks. At R_WB = Id a foot points along x with its sole level.
struct Legs {
  BodyId leftFoot{}, rightFoot{};
  BodyId trunk{};                                  ///< kept upright
  Eigen::Vector3d p_FS = Eigen::Vector3d::Zero();  ///< middle of the sole in the frame of each foot, metres
};

struct WalkOptions {
  /// Its step is that of the pattern, its height that of the centre of mass above the ground.
  PreviewOptions preview{.height = 0.8, .step = 0.01};
  double lift = 0.05;       ///< metres that a foot rises above the ground
  double tolerance = 1e-8;  ///< metres and radians by which feet and centre of mass may miss their places
  int maxIterations = 30;   ///< of inverse kinematics for each posture
};

/// Postures of a robot that walks as planned.
struct WalkingPattern {
  enum class Status {
    kWalks,
    kNoPreview,  ///< there are no gains of preview control
    kUnreached  ///< at some time feet and centre of mass cannot be where they should, within the joint limits
  };
  Status status = Status::kUnreached;
  Eigen::MatrixXd Q{};  ///< nq x N: a column for each step of the preview; until where it came, if kUnreached
  PreviewMotion center{};   ///< of the centre of mass, seen from above
  double largestError = 0;  ///< of all postures in Q: of feet and centre of mass, metres and radians
  std::string message{};    ///< says when and how far off
};

/// Where the middle of a sole should be at time t (seconds), turned by yaw, on level ground at z = 0:
/// standing, or on its way by a minimum jerk profile, with a bump of the height `lift`, turning the shorter
/// way round. Throws Error as phaseAt().
[[nodiscard]] Pose solePose(const WalkPlan& plan, Side side, double t, double lift);

/// Plans footsteps' zero moment point, its centre of mass by preview control (slide 11:12), and postures by
/// inverse kinematics, beginning near `start` (nq): feet and centre of mass first, then an upright trunk that
/// turns with the feet, then near to `start`. Throws Error as followZmp() and duration(), for a start of
/// another size, for a model without mass, and for options that are not positive.
[[nodiscard]] WalkingPattern walkingPattern(const Model& model, const Legs& legs, const WalkPlan& plan,
                                            const VectorArg& start, const WalkOptions& options = {});

}  // namespace rex

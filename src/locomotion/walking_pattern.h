#pragma once

#include "kinematics/forward_kinematics.h"
#include "locomotion/footsteps.h"
#include "locomotion/preview_control.h"

namespace rex {

/// The bodies of a robot that walk. At R_WB = Id a foot points along x with its sole level.
struct Legs {
  BodyId leftFoot{}, rightFoot{};
  BodyId trunk{};                 ///< kept upright
  Eigen::Vector3d p_FS{0, 0, 0};  ///< centre of the sole in the frame of each foot, metres
};

struct WalkOptions {
  /// Its step is the pattern's time step, its height that of the centre of mass above the ground.
  PreviewOptions preview{.height = 0.8, .step = 0.01};
  double lift = 0.05;       ///< height to which a foot is lifted, metres
  double tolerance = 1e-8;  ///< permitted error of the feet and the centre of mass, metres and radians
  int maxIterations = 30;   ///< for the inverse kinematics of each posture
};

/// Postures of a robot that walks as planned.
struct WalkingPattern {
  enum class Status {
    kWalks,
    kNoPreview,  ///< no preview gains were found
    kUnreached   ///< at some time the feet and the centre of mass cannot reach their targets within the joint
                 ///< limits
  };
  Status status = Status::kUnreached;
  Eigen::MatrixXd Q{};      ///< nq x N, one column per step of the preview; if kUnreached, up to the failure
  PreviewMotion center{};   ///< of the centre of mass, seen from above
  double largestError = 0;  ///< over all postures in Q, of feet and centre of mass, metres and radians
  std::string message{};    ///< says when and how far off
};

/// The desired pose of the centre of a sole at time t (seconds) on level ground at z = 0. A swinging foot
/// follows a minimum jerk profile with a bump of height `lift` and turns the shorter way round. Throws
/// Error like phaseAt().
[[nodiscard]] Pose solePose(const WalkPlan& plan, Side side, double t, double lift);

/// Plans the zero moment point from the footsteps, the centre of mass by preview control (slide 11:12), and
/// postures by inverse kinematics, beginning near `start` (nq). Priorities: feet and centre of mass, then
/// an upright trunk that turns with the feet, then closeness to `start`. Throws Error like followZmp() and
/// duration(), for a start of the wrong size, a model without mass, and options that are not positive.
[[nodiscard]] WalkingPattern walkingPattern(const Model& model, const Legs& legs, const WalkPlan& plan,
                                            const VectorArg& start, const WalkOptions& options = {});

}  // namespace rex

#pragma once

#include <string>

#include "control/riccati.h"
#include "kinematics/forward_kinematics.h"
#include "locomotion/footsteps.h"

namespace rex {

/// The model and weights of preview control. Kajita et al. 2003, Biped walking pattern generation by using
/// preview control of zero-moment point (slide 11:12); the servo of Katayama et al. 1985.
struct PreviewOptions {
  double height = 0.814;  ///< of the centre of mass above the ground, metres
  double g = 9.81;        ///< m/s^2
  double step = 0.005;    ///< seconds
  double preview = 1.6;   ///< seconds of the reference that are known ahead; rounded to whole steps
  double Qe = 1;          ///< weight of squared errors of the zero moment point, per step
  double R = 1e-6;        ///< weight of squared changes of the jerk from step to step
};

/// Gains for x = (c, c', c''), the jerk u and the zero moment point p = c - height / g c'' of one axis: u_k
/// - u_{k-1} = -Gi (p_k - r_k) - Gx (x_k - x_{k-1}) + sum_j Gp_j (r_{k+j} - r_{k+j-1}). Summed up this is
/// the published law, u_k = -Gi sum_{i <= k} (p_i - r_i) - Gx x_k + sum_j Gp_j r_{k+j}, if everything
/// starts at rest.
struct PreviewGains {
  RiccatiStatus status = RiccatiStatus::kFailed;
  double Gi = 0;
  Eigen::RowVector3d Gx = Eigen::RowVector3d::Zero();
  Eigen::VectorXd Gp{};  ///< for r_{k + 1}, r_{k + 2}, ...; empty unless status is kSolved
  std::string message{};
};

/// The gains that minimise the sum of Qe (p - r)^2 + R (u_k - u_{k-1})^2 over all time, by solveDare(). The
/// reference is assumed constant beyond the preview. Throws Error for options that are not positive, and
/// for a preview of less than one step or more than 100 000.
[[nodiscard]] PreviewGains previewGains(const PreviewOptions& options);

/// A motion of the centre of mass whose zero moment point follows a reference: one column per time, x and y
/// as rows, metres and seconds.
struct PreviewMotion {
  RiccatiStatus status = RiccatiStatus::kFailed;  ///< of the gains; all below is empty unless kSolved
  Eigen::Matrix2Xd c{}, v{}, a{};                 ///< of the centre of mass
  Eigen::Matrix2Xd zmp{};                         ///< of the cart on a table: c - height / g a
  double largestError = 0;                        ///< max |zmp - reference| over all times and axes, metres
  std::string message{};
};

/// Follows `reference` (2 x N, x and y in W, metres, one column per step), starting at rest above its first
/// column. After its end the reference is taken as constant. Throws Error like previewGains(), for a
/// reference without columns, and for numbers that are not finite.
[[nodiscard]] PreviewMotion followZmp(const Eigen::Ref<const Eigen::Matrix2Xd>& reference,
                                      const PreviewOptions& options);

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

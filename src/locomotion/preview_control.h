#pragma once

#include <string>

#include "control/riccati.h"

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

}  // namespace rex

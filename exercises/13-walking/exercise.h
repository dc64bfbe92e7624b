#pragma once

#include <optional>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. Metres, seconds, radians, kilograms; z points up, and gravity is
// (0, 0, -g). Slides are named as chapter:number.

// Part 1, standing (11:7).

/// The corners of the support polygon (2 x k): the hull of the contacts (2 x N, seen from above, in any
/// order, some of them perhaps in one place). Counter-clockwise, beginning anywhere; only true corners, none
/// between two others on an edge. Contacts on one line have its two ends for corners, contacts in one place
/// have one, no contacts none. Coordinates are whole multiples of 1/1024 m: cross products of them have no
/// rounding.
Eigen::MatrixXd supportCorners(const Eigen::MatrixXd& contacts);

/// How far a point is from the border of a polygon that is given as above, with one corner or more: positive
/// inside, negative outside. A line and a single point have no inside: 0 on them, negative beside them.
double borderDistance(const Eigen::MatrixXd& corners, const Eigen::Vector2d& point);

/// A part of a robot as a point: mass, position and acceleration.
struct MovingMass {
  double mass = 1;
  Eigen::Vector3d p = Eigen::Vector3d::Zero(), a = Eigen::Vector3d::Zero();
};

/// Static stability (11:7): the borderDistance() of the centre of mass, seen from above, with these contacts
/// (one or more). The accelerations do not matter.
double staticMargin(const std::vector<MovingMass>& robot, const Eigen::MatrixXd& contacts);

// Part 2, the zero moment point (11:10) and the linear inverted pendulum (11:12).

/// x and y of the zero moment point on level ground at z = groundHeight: about it the forces m (a - gravity)
/// have no moment along x and y. None, if the ground does not push: their vertical part is zero or less.
std::optional<Eigen::Vector2d> zeroMoment(const std::vector<MovingMass>& robot, double groundHeight,
                                          double g);

/// A centre of mass that keeps its height above the ground, without any turning of the body.
struct Pendulum {
  double height = 0.8;
  double g = 9.81;
};

/// Where it is, seen from above, and how fast.
struct Sway {
  Eigen::Vector2d c = Eigen::Vector2d::Zero(), v = Eigen::Vector2d::Zero();
};

/// The motion t >= 0 seconds after `start`, while the zero moment point stays at p. In closed form, exact.
Sway swayed(const Pendulum& pendulum, const Sway& start, const Eigen::Vector2d& p, double t);

/// The capture point: where the zero moment point must be, and stay, so that the motion comes to rest.
Eigen::Vector2d capturePoint(const Pendulum& pendulum, const Sway& now);

// Part 3, preview control (11:12; Kajita et al. 2003).

/// A cart on a massless table, for x and for y each. Its state is x = (c, c', c''); in each step the jerk u
/// is held, and the zero moment point is p = c - height / g c''.
struct CartTable {
  double height = 0.814;
  double g = 9.81;
  double step = 0.005;
  int ahead = 320;  ///< N, of how many steps ahead the wanted zero moment point is known
  double Qe = 1;    ///< price of (p_k - r_k)^2, for each k
  double R = 1e-6;  ///< price of (u_k - u_(k-1))^2, for each k
};

/// The state one step later, exact.
Eigen::Vector3d cartStep(const CartTable& cart, const Eigen::Vector3d& x, double jerk);

/// Gains of the law u_k = u_(k-1) - Gi (p_k - r_k) - Gx (x_k - x_(k-1)) + sum_j Gp_j (r_(k+j) - r_(k+j-1)),
/// j = 1 ... N.
struct PreviewLaw {
  double Gi = 0;
  Eigen::RowVector3d Gx = Eigen::RowVector3d::Zero();
  Eigen::VectorXd Gp;  ///< N: the first number is that of j = 1
};

/// The gains for which the sum of all prices is least, if the reference r stays what it is after the preview.
/// Right to a millionth. The Riccati equation behind them you need not solve yourself: see the README.
PreviewLaw previewLaw(const CartTable& cart);

/// The states x_0, x_1, ... (3 x n) under this law, whatever its gains, for n numbers of the reference. At
/// first the cart stands over r_0: x_0 = (r_0, 0, 0), u_(-1) = 0, x_(-1) = x_0. After its last number the
/// reference stays what it is.
Eigen::MatrixXd followed(const CartTable& cart, const PreviewLaw& law, const Eigen::VectorXd& reference);

// Part 4, the compass gait (11:19, 11:20, 11:22).

/// Two straight legs that walk down a slope by themselves: each a mass `a` above its foot and `b` below the
/// hip, where the legs meet in another mass. The state is x = (theta_s, theta_ns, and their rates) of the
/// stance and the swing leg: angles from the vertical, counter-clockwise. Downhill is to the right, so that
/// the stance angle falls. The swing equation is in swing.h.
struct Walker {
  double a = 0.5, b = 0.5;
  double legMass = 5;  ///< of each leg
  double hipMass = 10;
  double slope = 0.05235987755982989;  ///< 3 degrees downhill
  double g = 9.8;
};

/// The state just after an impact, from that just before it (11:22): without rebound, slip or force on the
/// foot behind. The legs change their parts: the first angle is again that of the leg that stands.
Eigen::Vector4d impactOf(const Walker& walker, const Eigen::Vector4d& x);

/// How a step ends: just after its impact.
struct StepEnd {
  Eigen::Vector4d x = Eigen::Vector4d::Zero();
  double time = 0;  ///< from the beginning of the step
};

/// One step, from a state with the swing foot behind. Both feet are on the slope where theta_s + theta_ns =
/// -2 slope; the swing foot lands where that sum falls to this value, and the foot is in front. Before, it
/// may pass below the ground. None: the walker falls (|theta_s + slope| reaches pi / 2), or does not land
/// within 5 s. The end is right to 1e-7, in all five numbers.
std::optional<StepEnd> stepFrom(const Walker& walker, const Eigen::Vector4d& x);

/// The derivative of the x of stepFrom() by all four numbers of the state where it begins. Entries right to
/// 1e-4 of the greatest. The walker does not fall.
Eigen::Matrix4d stepDerivative(const Walker& walker, const Eigen::Vector4d& x);

/// The gait near `guess`, stable or not: the state just after an impact that a step reproduces, within 1e-7.
/// The guess is so near that Newton's method gets there. None, if the walker falls from the guess.
std::optional<Eigen::Vector4d> gaitNear(const Walker& walker, const Eigen::Vector4d& guess);

/// The moduli of the four multipliers of a gait, falling, right to 0.01: by how much a small disturbance
/// grows from step to step.
Eigen::VectorXd multiplierSizes(const Walker& walker, const Eigen::Vector4d& gait);

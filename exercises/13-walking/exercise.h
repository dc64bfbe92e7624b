#pragma once

#include <optional>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. Metres, seconds, radians, kilograms; z points up, and gravity is
// (0, 0, -g). Slides are named as chapter:number.

// Part 1, standing (11:7).

/// The corners of the support polygon (2 x k): the hull of the contacts (2 x N, seen from above, in any
/// order; some may coincide). Counter-clockwise, beginning anywhere; only true corners, none between two
/// others on an edge. If all contacts lie on one line, its two ends are the corners; if all coincide, there
/// is one corner, and without contacts none. Coordinates are whole multiples of 1/1024 m: cross products of
/// them have no rounding.
Eigen::MatrixXd supportCorners(const Eigen::MatrixXd& contacts);

/// How far a point is from the border of a polygon that is given as above, with one corner or more: positive
/// inside, negative outside. A line and a single point have no inside: 0 on them, negative beside them.
/// Accurate to 1e-9 m.
double borderDistance(const Eigen::MatrixXd& corners, const Eigen::Vector2d& point);

/// A part of a robot as a point: mass, position and acceleration.
struct MovingMass {
  double mass = 1;
  Eigen::Vector3d p = Eigen::Vector3d::Zero(), a = Eigen::Vector3d::Zero();
};

/// Static stability (11:7): the borderDistance() of the centre of mass, seen from above, with these contacts
/// (one or more). The accelerations do not matter. Accurate to 1e-9 m.
double staticMargin(const std::vector<MovingMass>& robot, const Eigen::MatrixXd& contacts);

// Part 2, the zero moment point (11:10) and the linear inverted pendulum (11:12).

/// x and y of the zero moment point on level ground at z = groundHeight: about it the forces m (a - gravity)
/// have no moment along x and y, accurate to 1e-9 of the sum of m (|a| + g) (1 m + |p|). Returns nothing if
/// the vertical component of the sum of these forces is zero or negative: the ground cannot pull.
std::optional<Eigen::Vector2d> zeroMoment(const std::vector<MovingMass>& robot, double groundHeight,
                                          double g);

/// The linear inverted pendulum: the centre of mass stays at `height` above the ground, and the body does not
/// rotate.
struct Pendulum {
  double height = 0.8;
  double g = 9.81;
};

/// Position and velocity of the centre of mass, seen from above.
struct Sway {
  Eigen::Vector2d c = Eigen::Vector2d::Zero(), v = Eigen::Vector2d::Zero();
};

/// Position and velocity of the centre of mass t >= 0 seconds after `start`, while the zero moment point
/// stays at p. In closed form: with omega^2 = g / height, the position is accurate to
/// 1e-10 (|c| + |p| + |v| / omega) exp(omega t), and the velocity to omega times that.
Sway swayed(const Pendulum& pendulum, const Sway& start, const Eigen::Vector2d& p, double t);

/// The capture point: where the zero moment point must be, and stay, so that the body comes to rest above
/// it. Accurate to 1e-9 m.
Eigen::Vector2d capturePoint(const Pendulum& pendulum, const Sway& now);

// Part 3, preview control (11:12; Kajita et al. 2003).

/// A cart on a massless table; there is one such cart for each horizontal axis. Here x is its state and not
/// an axis: x = (c, c', c''), where c is the position along the axis. In each time step the jerk u is
/// constant, and the zero moment point is p = c - height / g c''.
struct CartTable {
  double height = 0.814;
  double g = 9.81;
  double step = 0.005;  ///< length of a time step
  int ahead = 320;  ///< N, for how many time steps ahead the reference is known: the wanted zero moment point
  double Qe = 1;    ///< weight of (p_k - r_k)^2, for each k
  double R = 1e-6;  ///< weight of (u_k - u_(k-1))^2, for each k
};

/// The state one time step later, exact.
Eigen::Vector3d cartStep(const CartTable& cart, const Eigen::Vector3d& x, double jerk);

/// Gains of the law u_k = u_(k-1) - Gi (p_k - r_k) - Gx (x_k - x_(k-1)) + sum_j Gp_j (r_(k+j) - r_(k+j-1)),
/// j = 1 ... N.
struct PreviewLaw {
  double Gi = 0;
  Eigen::RowVector3d Gx = Eigen::RowVector3d::Zero();
  Eigen::VectorXd Gp;  ///< N numbers; Gp[0] belongs to j = 1
};

/// The gains for which the total cost is minimal, if the reference r stays constant after the preview. Gi and
/// each number of Gx are accurate to 1e-6 of their value, Gp to 1e-6 of its largest number. You need not
/// solve the Riccati equation behind them yourself: see the README.
PreviewLaw previewLaw(const CartTable& cart);

/// The states x_0, x_1, ... (3 x n) under this law, for n numbers of the reference and for any gains, not
/// only those of previewLaw(); Gp has cart.ahead numbers. At first the cart stands over r_0:
/// x_0 = (r_0, 0, 0), u_(-1) = 0, x_(-1) = x_0. After its last number the reference stays constant.
Eigen::MatrixXd followed(const CartTable& cart, const PreviewLaw& law, const Eigen::VectorXd& reference);

// Part 4, the compass gait (11:19, 11:20, 11:22).

/// Two straight legs that walk down a slope by themselves: each leg has a point mass at distance `a` from its
/// foot and `b` from the hip; a third is at the hip. The state is x = (theta_s, theta_ns, and their rates):
/// the angles of the stance and the swing leg, of the vector from foot to hip for each, counter-clockwise
/// from the vertical. Downhill is to the right, so a leg with a positive angle leans uphill, and the stance
/// angle decreases as the walker moves on. The swing equation is in swing.h.
struct Walker {
  double a = 0.5, b = 0.5;
  double legMass = 5;  ///< of each leg
  double hipMass = 10;
  double slope = 0.05235987755982989;  ///< 3 degrees downhill
  double g = 9.8;
};

/// The state just after an impact, from that just before it (11:22): without rebound, slip or force on the
/// foot behind. The legs swap roles: the first angle is again that of the leg that stands. The angles are
/// accurate to 1e-12 rad, and the angular momenta that the impact does not change to
/// 1e-10 (hipMass + 2 legMass) (a + b)^2 (|rates before| + |rates after|).
Eigen::Vector4d impactOf(const Walker& walker, const Eigen::Vector4d& x);

/// How a step ends: just after its impact.
struct StepEnd {
  Eigen::Vector4d x = Eigen::Vector4d::Zero();
  double time = 0;  ///< from the beginning of the step
};

/// One step, from a state with the swing foot behind. Both feet are on the slope where theta_s + theta_ns =
/// -2 slope. Landing: the sum falls through -2 slope while the swing foot is in front of the stance foot.
/// Before that the swing foot may be below the ground; this does not count. Returns nothing if the walker
/// falls (|theta_s + slope| reaches pi / 2), or does not land within 5 s. All five numbers of the end are
/// accurate to 1e-7.
std::optional<StepEnd> stepFrom(const Walker& walker, const Eigen::Vector4d& x);

/// The Jacobian of the end state of stepFrom() with respect to the start state. Its entries are accurate to
/// 1e-4 of the largest. You may assume that the walker does not fall.
Eigen::Matrix4d stepDerivative(const Walker& walker, const Eigen::Vector4d& x);

/// The gait near `guess`, stable or not: the state after an impact to which a step returns, to 1e-7. The
/// guess is so near that Newton's method gets there. Returns nothing if the walker falls when it starts at
/// the guess.
std::optional<Eigen::Vector4d> gaitNear(const Walker& walker, const Eigen::Vector4d& guess);

/// The moduli of the four Floquet multipliers of a gait, in descending order, accurate to 0.01. The
/// multipliers are the eigenvalues of stepDerivative() at the gait, the factors by which a small disturbance
/// grows from step to step.
Eigen::VectorXd multiplierSizes(const Walker& walker, const Eigen::Vector4d& gait);

#pragma once

#include <string>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. SI units; positions are metres in the world frame, angles radians;
// n is the number of joints. Every robot and every point here is simulated in steps of tau = 0.01 s, during
// which the force is constant. A check of a robot ends at once if a joint force exceeds 1000 N m or a joint
// turns faster than 200 rad/s. Slides are cited as chapter:number.

// Part 1, a point mass (12.5.1 a and b).

/// The position [m] and velocity [m/s] of a point on a line.
struct PointState {
  double q = 0, v = 0;
};

/// One explicit Euler step of tau seconds of a point of that mass [kg] under the force u [N]: 3:6, 12.5.1.
PointState eulerStep(const PointState& at, double u, double mass, double tau);

/// Gains of a PD controller: N/m and N s/m.
struct Gains {
  double Kp = 0, Kd = 0;
};

/// The force [N] of PD control towards the `wanted` position and velocity: 3:10.
double pdForce(const PointState& at, const PointState& wanted, const Gains& gains);

/// How a point approaches its goal (3:12 to 3:14), from rest. kOscillatory: it overshoots by 3 to 60 % of its
/// way, and crosses its goal at least twice. kCritical: it overshoots by at most 0.2 %, and takes at most 3.1
/// times as long to cover 95 % of the way as to cover half of it (true for xi = 1). kOverdamped: it
/// overshoots by at most 0.2 %, and takes at least 3.3 times as long (true for xi >= 1.3).
enum class Regime { kOscillatory, kCritical, kOverdamped };

/// Gains with which a point of that mass [kg] reaches a goal from rest in T seconds (1 to 5), in that regime:
/// after T it stays within 1 % of the initial distance to the goal; at T/4 it is not yet there for good.
Gains gainsFor(Regime regime, double T, double mass);

// Part 2, PID control (12.5.1 c).

/// Gains of a PID controller: N/m, N/(m s) and N s/m.
struct PidSettings {
  double Kp = 0, Ki = 0, Kd = 0;
};

/// The force u [N], and the integral of the position error [m s] to hand to the next step.
struct PidStep {
  double u = 0, integral = 0;
};

/// One step of PID control: 3:15 and 3:16. The force uses the `integral` passed in, or 0 if `restart` is
/// true, as when the controller is switched on. The returned integral is the one used plus tau times the
/// present position error, as in an Euler step.
PidStep pidStep(const PointState& at, const PointState& wanted, const PidSettings& gains, double integral,
                double tau, bool restart);

/// Whether a point of that mass [kg] under this control (in continuous time) comes to rest at its goal, from
/// wherever it starts. Gains may be zero or negative. Exact: an oscillation that neither grows nor dies does
/// not come to rest. With Ki = 0 this is PD control: the integral may grow, since it has no effect.
bool isStable(const PidSettings& gains, double mass);

// Part 3, following a reference (12.5.2).

/// The force [N] on a point of that mass [kg] at time t [s] to follow q*(t) = cos(t). On the reference it is
/// the force that the reference motion needs. If pushed off it, the point comes back within a second in the
/// given regime, as in gainsFor() with T = 1.
double followForce(const PointState& at, double t, double mass, Regime regime);

// Part 4, holding an arm without knowing it (12.6.2 a).

/// The forces (3, N m) of one PD controller per joint that hold pegArm.ors at q = 0 (3, rad); v (3, rad/s).
/// Each joint has its own gains and knows nothing of the others, nor of the arm's dynamics. Under noise of
/// strength 1 and a push of 1 rad/s on all joints after one second, no joint gets farther than 0.6 rad from
/// zero in 4 s. During the last second, the largest |q_i| is at most 0.25 rad on average, and no joint
/// exceeds 3 rad/s. The same must hold if each mass, with its inertia, is up to 15 % more or less than in the
/// file.
Eigen::VectorXd holdArm(const Eigen::VectorXd& q, const Eigen::VectorXd& v);

// Part 5, computed torque (12.6.2 b).

/// A point on a path in joint or task space: its position, velocity and acceleration, d numbers each.
struct PathPoint {
  Eigen::VectorXd y, yd, ydd;
};

/// The acceleration (d) with which y (d), whose velocity is yd (d), returns to its reference like a point of
/// mass 1 with wave length lambda [s] and damping ratio xi: 3:14 with 3:30 or 3:34.
Eigen::VectorXd wantedAcceleration(const Eigen::VectorXd& y, const Eigen::VectorXd& yd,
                                   const PathPoint& reference, double lambda, double xi);

/// The joint forces (n) that give the joints the acceleration qdd (n), for M (n x n) and F (n) of 3:28.
Eigen::VectorXd computedTorque(const Eigen::MatrixXd& M, const Eigen::VectorXd& F,
                               const Eigen::VectorXd& qdd);

// Part 6, operational space control (3:32 to 3:35).

/// The acceleration [m/s^2] that the origin of `body` has in the present posture and velocities of S while
/// the joints keep their velocity: the derivative of J times the joint velocity. Within 1e-4 of its size, or
/// of 1 m/s^2 if that is more. The function may change the posture of S and need not restore it.
Eigen::Vector3d accelerationBias(rex::Simulator& S, const std::string& body);

/// A task: the acceleration that some y (d) should have.
struct AccelerationTask {
  Eigen::MatrixXd J;          ///< Jacobian of y, d x n
  Eigen::VectorXd bias, ydd;  ///< acceleration of y at constant joint velocity, and the wanted one, d each
  Eigen::MatrixXd C;          ///< weight of an error in acceleration, d x d, symmetric positive definite
};

/// The u (n) that minimises |achieved - wanted acceleration|^2_C + |u|^2_H: 3:33 with the right derivative of
/// J qdot. M (n x n), F (n) as in 3:28; H (n x n) is symmetric positive definite.
Eigen::VectorXd operationalForce(const AccelerationTask& task, const Eigen::MatrixXd& M,
                                 const Eigen::VectorXd& F, const Eigen::MatrixXd& H);

/// The joint forces (n, N m) with which the origin of `hand` follows its reference (3 numbers each), in the
/// present posture and velocities of S. Called at every step, it keeps the hand within 5 mm of its reference
/// on a line or a circle on which it starts, and no joint turns faster than 5 rad/s, although the hand leaves
/// some joint motions free. The function may change the posture of S and need not restore it.
Eigen::VectorXd followWithHand(rex::Simulator& S, const std::string& hand, const PathPoint& reference);

// Part 7, Newton and Euler (3:23, 3:24).

/// A link of a chain of hinges. Its frame L rotates about its own origin: at angle q its pose in the frame P
/// of the link before (the world, for the first) has the position p_PL and, as rotation, R_PL0 times the
/// rotation by q about `axis`.
struct ChainLink {
  Eigen::Matrix3d R_PL0 = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_PL = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();    ///< in L, a unit vector
  double mass = 0;                                    ///< kg
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   ///< of mass, in L
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about that centre, in the axes of L, kg m^2
};

/// The joint forces (n, N m) that give the joint accelerations a (n) at angles q (n) and velocities v (n),
/// under gravity [m/s^2, in the world frame], by the Newton-Euler recursion of 3:23. The first link comes
/// first; there is at least one.
Eigen::VectorXd newtonEuler(const std::vector<ChainLink>& chain, const Eigen::VectorXd& q,
                            const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                            const Eigen::Vector3d& gravity);

/// G(q) of 3:24, n numbers.
Eigen::VectorXd gravityTerm(const std::vector<ChainLink>& chain, const Eigen::VectorXd& q,
                            const Eigen::Vector3d& gravity);
/// C(q, v) v of 3:24, without gravity, n numbers.
Eigen::VectorXd coriolisTerm(const std::vector<ChainLink>& chain, const Eigen::VectorXd& q,
                             const Eigen::VectorXd& v);
/// M(q) of 3:24, n x n.
Eigen::MatrixXd inertiaMatrix(const std::vector<ChainLink>& chain, const Eigen::VectorXd& q);

// Part 8, a bonus: balancing a pin.

/// The forces (8, N m) that keep the pin of pin_balancing.ors upright, in the present posture and velocities
/// of S. The last two joints have no motor: return exactly 0 for them. `home` (8) is a posture in which the
/// pin stands upright. From there, with the pin tilted by up to 0.02 rad and all at rest, it does not tilt by
/// more than 0.1 rad in the next 5 s. After 5 s it tilts by at most 0.01 rad, and its foot, the
/// universalJoint, is within 8 cm of where it is at home, seen from above. The function may change the
/// posture of S and need not restore it.
Eigen::VectorXd balancePin(rex::Simulator& S, const Eigen::VectorXd& home);

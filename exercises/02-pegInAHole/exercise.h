#pragma once

#include <string>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. n is the number of joint angles of the robot in S; positions are
// metres in the world frame, directions unit vectors in it, angles radians. Slides are cited as
// chapter:number.

// Part 1, one task and its nullspace (12.4.1).

/// J# (n x d) of slide 2:29 for J (d x n), a symmetric positive definite W (n x n) and C = precision * Id:
/// dq = J# dy minimises precision * |J dq - dy|^2 + dq^T W dq.
Eigen::MatrixXd regularisedInverse(const Eigen::MatrixXd& J, const Eigen::MatrixXd& W, double precision);

/// N = I - J# J of slide 2:36 in the limit of infinite precision, for W = Id (n x n): J N a is zero for every
/// a, and N a = a if J a is zero already. J (d x n) has any rank; its singular values below 1e-9 of the
/// largest count as zero.
Eigen::MatrixXd nullspaceProjector(const Eigen::MatrixXd& J);

// Part 2, several tasks at once (12.4.2).

/// One of several tasks in a posture q (2:47): its error phi(q) - y* (d numbers), its Jacobian J (d x n), and
/// its precision, the factor rho of its squared error.
struct TaskTerm {
  Eigen::VectorXd error;
  Eigen::MatrixXd J;
  double precision = 1;
};

/// The step dq (n numbers) that minimises dq^T W dq + the sum of precision * |error + J dq|^2 over the tasks:
/// slide 2:48. W (n x n) is symmetric positive definite; there is at least one task.
Eigen::VectorXd multiTaskStep(const std::vector<TaskTerm>& tasks, const Eigen::MatrixXd& W);

/// T steps with W = Id and three tasks at once. Precision 1e4: at step t = 1, ..., T the origin of `hand` is
/// at center + radius * (cos(t / 20), 0, sin(t / 20)). Precision 100: the z axis of `pointing` points
/// upwards. Precision 0.01: the posture is the one that S starts in. Moves S, and returns the postures q_1,
/// ..., q_T (n numbers each).
std::vector<Eigen::VectorXd> circleWithTasks(rex::Simulator& S, const std::string& hand,
                                             const Eigen::Vector3d& center, double radius,
                                             const std::string& pointing, int T);

// Part 3, a peg in a hole (2:38 to 2:43). `peg` is a body; its position is that of its origin, its direction
// that of its z axis. The clearance is the least distance between two shapes that may collide, as in
// S.reportProxies(); below zero they overlap.

/// The sine profile of slide 2:40 at s in [0, 1].
double sineProfile(double s);

/// Joint-space interpolation (2:41): q_1, ..., q_T on the straight line from q0 to qT with the sine profile;
/// q_T is qT.
std::vector<Eigen::VectorXd> jointSpaceMotion(const Eigen::VectorXd& q0, const Eigen::VectorXd& qT, int T);

/// A posture in which `peg` is at `place` (within 1 mm) and points along `direction` (within 0.01), with a
/// clearance of at least margin / 2. It is found from the posture of S by many small steps, so that the arm
/// need not flip over; S may move.
Eigen::VectorXd pegPosture(rex::Simulator& S, const std::string& peg, const Eigen::Vector3d& place,
                           const Eigen::Vector3d& direction, double margin);

/// Task-space interpolation (2:42): in T steps the peg moves from where it is to `place`, on the straight
/// line with the sine profile (within 5 mm at each step, 1 mm at the last), in the direction that it has at
/// the start (within 0.05, then 0.01), with a clearance of at least margin / 2 all the way, as it has at the
/// start. For T >= 100 no joint turns by more than 0.1 from one posture to the next. Moves S, and returns
/// q_1, ..., q_T.
std::vector<Eigen::VectorXd> taskSpaceMotion(rex::Simulator& S, const std::string& peg,
                                             const Eigen::Vector3d& place, double margin, int T);

/// From the posture of S, which keeps the margin, into the hole: a sequence of 10 to 1000 postures, without
/// that of S. In the last, `peg` is at `inside` and points along `direction`, as exactly as in pegPosture.
/// From each posture to the next all joints turn at constant speeds, none by more than 0.1. Nothing comes
/// nearer than margin / 2, not even between two postures. The hole is entered along `direction`; 0.6 m before
/// `inside` the peg is still outside.
std::vector<Eigen::VectorXd> insertPeg(rex::Simulator& S, const std::string& peg,
                                       const Eigen::Vector3d& inside, const Eigen::Vector3d& direction,
                                       double margin);

// Part 4, strict priority (2:50, done right).

/// The step dq (n numbers) that minimises three lengths in this order: |J1 dq - dy1|; among all minimisers
/// |J2 dq - dy2|; among those |dq|. J1 (d1 x n) and J2 (d2 x n) have any rank; singular values below 1e-9 of
/// the largest of J1 or J2 count as zero. A
/// regularisation of 1e-10 or so (2:51) is accurate enough.
Eigen::VectorXd priorityStep(const Eigen::MatrixXd& J1, const Eigen::VectorXd& dy1, const Eigen::MatrixXd& J2,
                             const Eigen::VectorXd& dy2);

// Part 5, a bonus: three task maps for a body that stands and bends.

/// A task map at the present posture: its value y (d numbers) and its Jacobian J = dy/dq (d x n).
struct TaskMapValue {
  Eigen::VectorXd y;
  Eigen::MatrixXd J;
};

/// Joint limits (2:59, d = 1): how far joint angles are within `margin` (> 0) of their limits or beyond them,
/// in all, divided by `margin`. Joints without limits have infinite ones, and add nothing.
TaskMapValue jointLimits(const rex::Simulator& S, double margin);

/// One of the masses that a robot consists of.
struct BodyMass {
  std::string body;
  double mass = 0;                                   ///< kg, not negative
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< its centre of mass, in the body's frame, metres
};

/// The centre of mass of all these masses in the world (2:61, d = 3), metres. Not all of them are zero.
TaskMapValue massCenter(const rex::Simulator& S, const std::vector<BodyMass>& masses);

/// The vector from a point of `frame` to a point of `body`, in the axes of `frame` (2:55, d = 3), metres. The
/// points are given as `inFrame` and `inBody`, each in the frame of its own body.
TaskMapValue relativePosition(const rex::Simulator& S, const std::string& body, const Eigen::Vector3d& inBody,
                              const std::string& frame, const Eigen::Vector3d& inFrame);

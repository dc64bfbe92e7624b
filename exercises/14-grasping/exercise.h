#pragma once

#include <vector>

#include "course/course.h"
#include "optim/linear_program.h"

// The functions you complete in main.cpp. Metres, newtons; everything in the frame of the object. Slides are
// named as chapter:number.

// Part 1, contacts (10:6).

/// A finger that touches an object at the point p and can only push: `normal` is a unit vector into the
/// object, `friction` is mu.
struct Finger {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double friction = 0;
};

/// The same in the plane.
struct PlanarFinger {
  Eigen::Vector2d p = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
  double friction = 0;
};

/// The wrench of a force that acts at p: (fx, fy, torque / length), all in newtons. The torque is about
/// `center` and positive counter-clockwise.
Eigen::Vector3d planarWrench(const Eigen::Vector2d& p, const Eigen::Vector2d& force,
                             const Eigen::Vector2d& center, double length);

/// The same in space, six numbers: (force, torque / length). Torques follow the right-hand rule.
Eigen::VectorXd spatialWrench(const Eigen::Vector3d& p, const Eigen::Vector3d& force,
                              const Eigen::Vector3d& center, double length);

/// Whether the finger can exert this force on the object: its component along the surface is at most
/// `friction` times its component along the normal. Zero force is always possible. A force that is outside
/// by less than 1e-9 of its size counts as inside.
bool inCone(const Finger& finger, const Eigen::Vector3d& force);

/// A pyramid inscribed in the friction cone (3 x edges): the forces along its edges, each with a normal
/// component of one newton. They lie on the cone, at equal angles around the normal, in any order. There
/// are 3 edges or more. Without friction all of them are the normal.
Eigen::MatrixXd pyramidEdges(const Finger& finger, int edges);

/// The wrenches of fingers in the plane (3 x 2 fingers): those of the two forces that bound each cone, each
/// with a normal component of one newton. First both of the first finger, in any order, then both of the
/// second, ...
Eigen::MatrixXd planarWrenches(const std::vector<PlanarFinger>& fingers, const Eigen::Vector2d& center,
                               double length);

/// The same in space, 6 x (edges * fingers), with pyramidEdges().
Eigen::MatrixXd spatialWrenches(const std::vector<Finger>& fingers, int edges, const Eigen::Vector3d& center,
                                double length);

// Part 2, force closure (10:5 to 10:7).

/// An answer with its proof, which is checked without asking how you found it.
struct Verdict {
  bool closed = false;
  /// If closed: a positive weight for each wrench, with the sum 1, such that the weighted sum of all wrenches
  /// is zero up to 1e-8 of the longest one; each weight is 1e-6 or more. If not: a unit vector u such that
  /// u.w >= -1e-8 |w| for each wrench w.
  Eigen::VectorXd proof;
};

/// Whether positive combinations of wrenches (d x N, one per column, d = 2 to 6, N >= 1) give every wrench.
/// No check uses sets where rounding decides.
Verdict judged(const Eigen::MatrixXd& wrenches);

// Part 3, quality (10:9). The fingers together push with one newton, so that they can exert the wrenches in
// the convex hull of the columns.

/// The largest s such that s * direction is in the hull (d x N, d = 2 to 6). The direction is a unit
/// vector, and the columns have force closure. Accurate to 1e-6.
double reachAlong(const Eigen::MatrixXd& wrenches, const Eigen::VectorXd& direction);

/// The radius of the largest ball around zero in the hull, 3 x N with N up to 30. Zero without force
/// closure. Accurate to 1e-6 of the longest wrench.
double epsilonOf(const Eigen::MatrixXd& wrenches);

// Part 4, fewer fingers (10:8).

/// Which fingers to keep so that their wrenches still have force closure, and lose it if any one of them is
/// removed: indices of fingers in ascending order. Column k of the wrenches (d x N) belongs to the finger
/// finger[k]. Empty if all fingers together have no force closure.
std::vector<int> keptFingers(const Eigen::MatrixXd& wrenches, const std::vector<int>& finger);

// Part 5, a good grasp.

/// Where to put `count` fingers (2 to 4) on the edges of a polygon, so that epsilonOf() of their
/// planarWrenches() with this center and length is large: at least 0.8 of the best that the grader knows.
/// Corners are given counter-clockwise; the polygon may be concave. Fingers touch at least 2 mm from any
/// corner, with the normal of the edge and that friction. Objects are 5 to 20 cm large, their edges 15 mm
/// long or more. You have 10 s.
std::vector<PlanarFinger> bestGrasp(const std::vector<Eigen::Vector2d>& corners,
                                    const Eigen::Vector2d& center, double length, double friction, int count);

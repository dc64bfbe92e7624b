#pragma once

#include <optional>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. Metres and radians in the plane; left turns count positive. A pose
// is x = (x, y, heading), a heading any angle: two that differ by whole turns are the same. Slides are named
// as chapter:number.

// Part 1, the error of an edge (7:45).

/// The angle in [-pi, pi] that differs from `angle`, which may be any number, by whole turns.
double wrapped(double angle);

/// Pose b as seen from pose a: its position in the axes of a, and its heading relative to a's, wrapped.
Eigen::Vector3d seenFrom(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// The error of an edge: someone measured that pose j, seen from pose i, is z. How far is pose j from where
/// the measurement says? That is: j seen from the pose that, seen from i, is z.
Eigen::Vector3d edgeError(const Eigen::Vector3d& i, const Eigen::Vector3d& j, const Eigen::Vector3d& z);

/// The derivatives (3 x 3) of that error by the three numbers of pose i, and by those of pose j. By a formula
/// or by differences, right up to 1e-5.
struct EdgeJacobians {
  Eigen::Matrix3d byI = Eigen::Matrix3d::Zero(), byJ = Eigen::Matrix3d::Zero();
};
EdgeJacobians edgeJacobians(const Eigen::Vector3d& i, const Eigen::Vector3d& j, const Eigen::Vector3d& z);

// Part 2, the whole graph as one system of equations (7:45).

/// A measurement between two poses. Its information is the inverse of the covariance of its error.
struct MeasuredEdge {
  int from = 0, to = 0;  ///< numbers of the poses; either may be the larger
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
  bool isLoop = false;  ///< whether it came from closing a loop; odometry did not
};

/// Poses, and what was measured between them.
struct PoseMap {
  std::vector<Eigen::Vector3d> poses;
  std::vector<MeasuredEdge> edges;
};

/// The sum over all edges of e^T Omega e, with the information as Omega; no factor 1/2.
double mapCost(const PoseMap& map);

/// H = sum w J^T Omega J and b = sum w J^T Omega e over all edges, in all 3 n numbers of the n poses: pose 0
/// first, and within each pose x, y, heading. H as entries, both halves; entries at the same place add up.
struct NormalEquations {
  std::vector<rex::MatrixEntry> H;
  Eigen::VectorXd b;
};
/// `weights` has the number w of each edge; all are one if nothing else is said.
NormalEquations normalEquations(const PoseMap& map, const std::vector<double>& weights);

/// A step of Gauss and Newton: what to add to the 3 n numbers. Pose 0 stays where it is, so its three are
/// zero. For all others H dx = -b, with `damping` (0 or more) added to the diagonal of H first.
Eigen::VectorXd gaussNewtonStep(const PoseMap& map, const std::vector<double>& weights, double damping);

// Part 3, the best map (7:45).

/// Poses, and what they cost: first those given, then those after each step.
struct Adjusted {
  std::vector<Eigen::Vector3d> poses;
  std::vector<double> costs;
};

/// Moves the poses to where the cost is least, within a millionth of it; pose 0 stays. No step may make the
/// cost larger. Starts are poses that drifted, by odometry; or all of them, but pose 0, misplaced by 1 m, and
/// turned by 0.5 rad, standard deviations (edges are 1 m long). You have 200 steps.
Adjusted adjusted(const PoseMap& map);

// Part 4, scans (7:45): edges from what the robot saw.

/// Where the rays of a range scanner ended, in its own axes, in the order of the rays.
using Points = std::vector<Eigen::Vector2d>;

/// For each of the `moving` points, taken to the axes of the reference by the motion: the number of the
/// nearest point of the reference, or -1 if none is within maxDistance.
std::vector<int> partners(const Points& reference, const Points& moving, const Eigen::Vector3d& motion,
                          double maxDistance);

/// The motion (R, t) that minimises the sum of |R from[k] + t - to[k]|^2, in closed form: as many points of
/// both, at least two, and not all in one place.
Eigen::Vector3d bestMotion(const Points& from, const Points& to);

/// A motion between two scans, and how well they fit then.
struct Aligned {
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
  double residual = 0;  ///< root mean square distance of points from their partners within 0.3 m
  double overlap = 0;   ///< share of the moving points that have one
};

/// The pose of the moving scan seen from the reference: partners, best motion, and again. The guess is up to
/// 0.3 m and 0.2 rad off. On average over many pairs the motion is right within 4 cm and 0.02 rad, and no
/// single one is off by more than 20 cm or 0.1 rad. Ranges have noise of 2 cm, points of a wall lie about 15
/// cm apart, and a fifth of what one scan sees may be hidden from the other.
Aligned aligned(const Points& reference, const Points& moving, const Eigen::Vector3d& guess);

// Part 5, closing loops (7:46).

/// Do two scans show the same place? Then the motion from the reference to the moving one, else none. The
/// guess is up to 0.3 m and 0.2 rad off if they do. At least nine of ten pairs of the same place are found,
/// right within 20 cm and 0.1 rad; of different rooms at most one pair of ten is taken for the same.
std::optional<Eigen::Vector3d> loopMotion(const Points& reference, const Points& moving,
                                          const Eigen::Vector3d& guess);

// Part 6, wrong loops: the hard part.

/// The poses of a map some of whose loops, at most three of ten, are wrong by metres; odometry is right. The
/// positions are as if the wrong ones were not there, within 10 cm (root mean square), on five of eight maps:
/// some wrong loops cannot be told from right ones. Pose 0 stays. Starts are poses by odometry.
std::vector<Eigen::Vector3d> robustlyAdjusted(const PoseMap& map);

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

/// The error of an edge that measured z for pose j as seen from pose i: pose j as seen from where the
/// measurement puts it, which is the pose that is z as seen from i.
Eigen::Vector3d edgeError(const Eigen::Vector3d& i, const Eigen::Vector3d& j, const Eigen::Vector3d& z);

/// The derivatives (3 x 3) of this error with respect to the three numbers of pose i, and to those of pose
/// j. By a formula or by finite differences, accurate to 1e-5; also where the heading of the error jumps
/// from pi to -pi: the jump itself does not count.
struct EdgeJacobians {
  Eigen::Matrix3d byI = Eigen::Matrix3d::Zero(), byJ = Eigen::Matrix3d::Zero();
};
EdgeJacobians edgeJacobians(const Eigen::Vector3d& i, const Eigen::Vector3d& j, const Eigen::Vector3d& z);

// Part 2, the whole graph as one system of equations (7:45).

/// A measurement between two poses. Its information is the inverse of the covariance of its error.
struct MeasuredEdge {
  int from = 0, to = 0;  ///< indices of the poses; either may be the larger
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
  bool isLoop = false;  ///< whether it closes a loop; otherwise it is odometry
};

/// Poses, and what was measured between them.
struct PoseMap {
  std::vector<Eigen::Vector3d> poses;
  std::vector<MeasuredEdge> edges;
};

/// The sum over all edges of e^T Omega e, with the information as Omega; no factor 1/2.
double mapCost(const PoseMap& map);

/// H = sum w J^T Omega J and b = sum w J^T Omega e over all edges, in all 3 n numbers of the n poses: pose
/// 0 first, and within each pose x, y, heading. H is given by its entries, both halves; entries at the same
/// position add up.
struct NormalEquations {
  std::vector<rex::MatrixEntry> H;
  Eigen::VectorXd b;
};
/// `weights` has the weight w of each edge; all are one unless stated otherwise.
NormalEquations normalEquations(const PoseMap& map, const std::vector<double>& weights);

/// A Gauss-Newton step: what to add to the 3 n numbers. Pose 0 stays where it is, so its three are zero.
/// The others solve H dx = -b, after `damping` (0 or more) is added to the diagonal of H.
Eigen::VectorXd gaussNewtonStep(const PoseMap& map, const std::vector<double>& weights, double damping);

// Part 3, the best map (7:45).

/// Poses, and their costs: at first, and after each step.
struct Adjusted {
  std::vector<Eigen::Vector3d> poses;
  std::vector<double> costs;
};

/// Moves the poses to where the cost is minimal, within a millionth of it; pose 0 stays. No step may
/// increase the cost. The start is odometry, which has drifted, or all poses but pose 0 are off with
/// standard deviations of 1 m and 0.5 rad (edges are 1 m long). You have 200 steps.
Adjusted adjusted(const PoseMap& map);

// Part 4, scans (7:45): edges from what the robot saw.

/// Where the rays of a range scanner ended, in its own frame, in the order of the rays.
using Points = std::vector<Eigen::Vector2d>;

/// For each of the `moving` points, taken to the frame of the reference by the motion: the index of the
/// nearest point of the reference, or -1 if none is within maxDistance.
std::vector<int> partners(const Points& reference, const Points& moving, const Eigen::Vector3d& motion,
                          double maxDistance);

/// The motion (R, t) that minimises the sum of |R from[k] + t - to[k]|^2, in closed form. There are as many
/// points in both, at least two, and they do not all coincide.
Eigen::Vector3d bestMotion(const Points& from, const Points& to);

/// A motion between two scans, and how well they fit with it.
struct Aligned {
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
  double residual = 0;  ///< root mean square distance of points from their partners within 0.3 m
  double overlap = 0;   ///< share of the moving points that have one
};

/// The pose of the moving scan seen from the reference: alternates between partners and the best motion.
/// The guess is up to 0.3 m and 0.2 rad off. On average over many pairs the motion is accurate to 4 cm and
/// 0.02 rad, and none is off by more than 20 cm or 0.1 rad. Ranges have noise of 2 cm, points of a wall lie
/// about 15 cm apart, and a fifth of what one scan sees may be hidden from the other.
Aligned aligned(const Points& reference, const Points& moving, const Eigen::Vector3d& guess);

// Part 5, closing loops (7:46).

/// The motion from the reference to the moving scan if both show the same place, otherwise nothing. If they
/// do, the guess is up to 0.3 m and 0.2 rad off. At least nine out of ten pairs of the same place are
/// found, accurate to 20 cm and 0.1 rad; at most one out of ten pairs of different rooms is taken for the
/// same place.
std::optional<Eigen::Vector3d> loopMotion(const Points& reference, const Points& moving,
                                          const Eigen::Vector3d& guess);

// Part 6, wrong loops: the hard part.

/// The poses of a map in which at most three out of ten loops are wrong by metres; odometry is right. On
/// five out of twelve maps the positions are those without the wrong loops, within 10 cm (root mean square):
/// some wrong loops cannot be distinguished from right ones. Pose 0 stays. The start is odometry. Twelve maps
/// of 120 poses have 10 s together: time for some hundred steps per map.
std::vector<Eigen::Vector3d> robustlyAdjusted(const PoseMap& map);

// Part 7, a bonus: calibrating a camera (7:43, 7:44). It sees points of the world (3 x n, metres) at pixels
// (2 x n), u to the right and v upwards, without distortion.

/// Maps a point X of the world to the pixel x with (x, 1) ~ P (X, 1): equal up to a factor, the depth. A
/// multiple of P, also a negative one, is the same camera.
using Projection = Eigen::Matrix<double, 3, 4>;

/// The P of the camera that sees these points, at least 6 and not in one plane, at these pixels. Without
/// noise every pixel is met within 1e-3, also if the points lie 300 m from the origin. With noise, for 20
/// points or more, the root mean square distance in the image is at most 1.3 times the least possible.
Projection projectionFromPoints(const Eigen::Matrix3Xd& points, const Eigen::Matrix2Xd& pixels);

/// The pixels to which P maps the points, minus those given (2 x n).
Eigen::Matrix2Xd reprojectionErrors(const Projection& P, const Eigen::Matrix3Xd& points,
                                    const Eigen::Matrix2Xd& pixels);

/// The P with the least sum of squared reprojection errors: at most 1.00001 times the least possible. The
/// given P is a guess whose errors are tens of pixels; the points, 20 or more, lie within 10 m of the origin.
Projection refined(const Projection& P, const Eigen::Matrix3Xd& points, const Eigen::Matrix2Xd& pixels);

/// Where the camera is in the world [m]: the one point that P maps to zero.
Eigen::Vector3d cameraPosition(const Projection& P);

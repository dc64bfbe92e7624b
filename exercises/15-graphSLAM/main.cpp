#include <algorithm>
#include <cmath>
#include <numbers>

#include "exercise.h"
#include "rooms.h"
#include "show.h"

using namespace rex;

double wrapped(double angle) {
  // TODO: angles that differ by whole turns are one and the same.
  return angle;
}

Eigen::Vector3d seenFrom(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  // TODO: the way from a to b, in the axes of a.
  return Eigen::Vector3d::Zero();
}

Eigen::Vector3d edgeError(const Eigen::Vector3d& i, const Eigen::Vector3d& j, const Eigen::Vector3d& z) {
  // TODO: what is j, seen from i? And that, seen from z?
  return Eigen::Vector3d::Zero();
}

EdgeJacobians edgeJacobians(const Eigen::Vector3d& i, const Eigen::Vector3d& j, const Eigen::Vector3d& z) {
  EdgeJacobians jacobians;
  // TODO: both rotations together are one, by heading i + heading z. What does each number of i move?
  return jacobians;
}

double mapCost(const PoseMap& map) {
  double cost = 0;
  // TODO: e^T Omega e of each edge.
  return cost;
}

NormalEquations normalEquations(const PoseMap& map, const std::vector<double>& weights) {
  NormalEquations equations{{}, Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(map.poses.size()))};
  // TODO: each edge adds to four blocks of H, and to two of b.
  return equations;
}

Eigen::VectorXd gaussNewtonStep(const PoseMap& map, const std::vector<double>& weights, double damping) {
  Eigen::VectorXd step = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(map.poses.size()));
  // TODO: solveSparse() solves H x = b. But H says nothing about where the map as a whole lies.
  return step;
}

Adjusted adjusted(const PoseMap& map) {
  Adjusted result{map.poses, {mapCost(map)}};
  // TODO: steps, until the cost no longer falls. And if a step makes it rise?
  return result;
}

std::vector<int> partners(const Points& reference, const Points& moving, const Eigen::Vector3d& motion,
                          double maxDistance) {
  std::vector<int> numbers(moving.size(), -1);
  // TODO: take each point along with the motion, and look for the nearest.
  return numbers;
}

Eigen::Vector3d bestMotion(const Points& from, const Points& to) {
  // TODO: the means first. Around them, which angle turns one set of points onto the other best?
  return Eigen::Vector3d::Zero();
}

Aligned aligned(const Points& reference, const Points& moving, const Eigen::Vector3d& guess) {
  Aligned result{guess, 0, 0};
  // TODO: partners, then the best motion for them. Once is not enough.
  return result;
}

std::optional<Eigen::Vector3d> loopMotion(const Points& reference, const Points& moving,
                                          const Eigen::Vector3d& guess) {
  // TODO: what do overlap and residual say, and what if you exchange the two scans?
  return {};
}

std::vector<Eigen::Vector3d> robustlyAdjusted(const PoseMap& map) {
  PoseMap now = map;
  // TODO: weigh each loop by how well it fits, adjust, and weigh again. All loops are wide of the mark at
  // first: who is wrong?
  return now.poses;
}

Projection projectionFromPoints(const Eigen::Matrix3Xd& points, const Eigen::Matrix2Xd& pixels) {
  // TODO: two linear equations for each point. Which P of length 1 fits them best?
  return Projection::Zero();
}

Eigen::Matrix2Xd reprojectionErrors(const Projection& P, const Eigen::Matrix3Xd& points,
                                    const Eigen::Matrix2Xd& pixels) {
  Eigen::Matrix2Xd errors = Eigen::Matrix2Xd::Zero(2, points.cols());
  // TODO: the third number of P (X, 1) is the depth.
  return errors;
}

Projection refined(const Projection& P, const Eigen::Matrix3Xd& points, const Eigen::Matrix2Xd& pixels) {
  Projection best = P;
  // TODO: Gauss-Newton steps in the twelve numbers of P. Which change of P changes no pixel?
  return best;
}

Eigen::Vector3d cameraPosition(const Projection& P) {
  // TODO: P (p, 1) = 0.
  return Eigen::Vector3d::Zero();
}

// What follows is given, and never graded: change it as you like. show.h says what each line draws.

int main() {
  // Part 1: an edge from pose i to pose j, 1 m ahead and turned by 0.5 rad, and what was measured instead.
  showEdge({2, 1, 3}, {1, 0, .5}, {1.1, .2, .4});

  // A walk around a block in a house, one and a quarter rounds.
  Rng rng(8);
  const Walk walk = walkThroughHouse(rng);

  // Parts 2 and 3: odometry and loops that are given.
  showGivenLoops(walk);

  // Parts 4 and 5: two scans; then edges and loops from all of them.
  showAlignment(walk.scans[7], walk.scans[9], {1.6, .25, .2});
  const PoseMap map = mapFromScans(walk, rng);
  showMap(walk, map);

  // Part 6: some loops join poses metres apart, as if a room looked like another.
  showWrongLoops(walk, map);

  // Part 7: a camera takes pictures of 40 points that were measured with a tape.
  showCalibration(40);
}

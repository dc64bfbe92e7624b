#include <algorithm>
#include <cmath>
#include <numbers>

#include "exercise.h"
#include "rooms.h"
#include "show.h"
// <solution headers>
// What a mistake in wrong.cpp takes from the library.
// <todo>
// </solution>

using namespace rex;

double wrapped(double angle) {
  // <solution wrapped>
  return std::remainder(angle, 2 * std::numbers::pi);
  // <todo>
  //| // TODO: angles that differ by whole turns are one and the same.
  //| return angle;
  // </solution>
}

Eigen::Vector3d seenFrom(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  // <solution seenFrom>
  const double c = std::cos(a[2]), s = std::sin(a[2]);
  const double x = b[0] - a[0], y = b[1] - a[1];
  return {c * x + s * y, c * y - s * x, wrapped(b[2] - a[2])};
  // <todo>
  //| // TODO: the way from a to b, in the axes of a.
  //| return Eigen::Vector3d::Zero();
  // </solution>
}

Eigen::Vector3d edgeError(const Eigen::Vector3d& i, const Eigen::Vector3d& j, const Eigen::Vector3d& z) {
  // <solution edgeError>
  return seenFrom(z, seenFrom(i, j));
  // <todo>
  //| // TODO: what is j, seen from i? And that, seen from z?
  //| return Eigen::Vector3d::Zero();
  // </solution>
}

EdgeJacobians edgeJacobians(const Eigen::Vector3d& i, const Eigen::Vector3d& j, const Eigen::Vector3d& z) {
  EdgeJacobians jacobians;
  // <solution edgeJacobians>
  const double c = std::cos(i[2] + z[2]), s = std::sin(i[2] + z[2]);
  const double x = j[0] - i[0], y = j[1] - i[1];
  jacobians.byJ << c, s, 0, -s, c, 0, 0, 0, 1;
  jacobians.byI = -jacobians.byJ;
  // Where pose i turns, pose j goes around it the other way.
  jacobians.byI(0, 2) = c * y - s * x;
  jacobians.byI(1, 2) = -c * x - s * y;
  // <todo>
  //| // TODO: both rotations together are one, by heading i + heading z. What does each number of i move?
  // </solution>
  return jacobians;
}

double mapCost(const PoseMap& map) {
  double cost = 0;
  // <solution mapCost>
  for (const MeasuredEdge& edge : map.edges) {
    const Eigen::Vector3d e = edgeError(map.poses[static_cast<std::size_t>(edge.from)],
                                        map.poses[static_cast<std::size_t>(edge.to)], edge.motion);
    cost += e.dot(edge.information * e);
  }
  // <todo>
  //| // TODO: e^T Omega e of each edge.
  // </solution>
  return cost;
}

// <solution addBlock>
// Adds a 3 x 3 block of H.
void addBlock(std::vector<MatrixEntry>& H, int row, int column, const Eigen::Matrix3d& block) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) H.push_back({3 * row + r, 3 * column + c, block(r, c)});
}
// <todo>
// </solution>

NormalEquations normalEquations(const PoseMap& map, const std::vector<double>& weights) {
  NormalEquations equations{{}, Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(map.poses.size()))};
  // <solution normalEquations>
  for (std::size_t k = 0; k < map.edges.size(); ++k) {
    const MeasuredEdge& edge = map.edges[k];
    const Eigen::Vector3d &i = map.poses[static_cast<std::size_t>(edge.from)],
                          &j = map.poses[static_cast<std::size_t>(edge.to)];
    const EdgeJacobians J = edgeJacobians(i, j, edge.motion);
    const Eigen::Matrix3d omega = weights[k] * edge.information;
    const Eigen::Matrix3d ofI = J.byI.transpose() * omega, ofJ = J.byJ.transpose() * omega;
    const Eigen::Vector3d e = edgeError(i, j, edge.motion);
    addBlock(equations.H, edge.from, edge.from, ofI * J.byI);
    addBlock(equations.H, edge.from, edge.to, ofI * J.byJ);
    addBlock(equations.H, edge.to, edge.from, ofJ * J.byI);
    addBlock(equations.H, edge.to, edge.to, ofJ * J.byJ);
    equations.b.segment<3>(3 * edge.from) += ofI * e;
    equations.b.segment<3>(3 * edge.to) += ofJ * e;
  }
  // <todo>
  //| // TODO: each edge adds to four blocks of H, and to two of b.
  // </solution>
  return equations;
}

Eigen::VectorXd gaussNewtonStep(const PoseMap& map, const std::vector<double>& weights, double damping) {
  Eigen::VectorXd step = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(map.poses.size()));
  // <solution gaussNewtonStep>
  const NormalEquations equations = normalEquations(map, weights);
  const int unknowns = static_cast<int>(step.size()) - 3;
  // Without the rows and columns of pose 0.
  std::vector<MatrixEntry> H;
  for (const MatrixEntry& entry : equations.H)
    if (entry.row >= 3 && entry.column >= 3) H.push_back({entry.row - 3, entry.column - 3, entry.value});
  for (int k = 0; k < unknowns; ++k) H.push_back({k, k, damping});
  step.tail(unknowns) = solveSparse(H, -equations.b.tail(unknowns));
  // <todo>
  //| // TODO: solveSparse() solves H x = b. But H says nothing about where the map as a whole lies.
  // </solution>
  return step;
}

// <solution moved>
std::vector<Eigen::Vector3d> moved(std::vector<Eigen::Vector3d> poses, const Eigen::VectorXd& step) {
  for (std::size_t k = 0; k < poses.size(); ++k) {
    poses[k] += step.segment<3>(3 * static_cast<Eigen::Index>(k));
    poses[k][2] = wrapped(poses[k][2]);
  }
  return poses;
}
// <todo>
// </solution>

Adjusted adjusted(const PoseMap& map) {
  Adjusted result{map.poses, {mapCost(map)}};
  // <solution adjusted>
  // Levenberg and Marquardt: a step that raises the cost is not taken, but damped.
  PoseMap now = map;
  const std::vector<double> weights(map.edges.size(), 1);
  double damping = 0;
  for (int trial = 0; trial < 150; ++trial) {
    PoseMap next = now;
    next.poses = moved(now.poses, gaussNewtonStep(now, weights, damping));
    const double before = result.costs.back(), after = mapCost(next);
    if (after > before) {
      if (after - before < 1e-12 * before) break;
      damping = std::max(1., 8 * damping);
      continue;
    }
    now = next;
    result.costs.push_back(after);
    damping = damping > 1 ? damping / 4 : 0;
    if (damping == 0 && before - after <= 1e-10 * before) break;
  }
  result.poses = now.poses;
  // <todo>
  //| // TODO: steps, until the cost no longer falls. And if a step makes it rise?
  // </solution>
  return result;
}

std::vector<int> partners(const Points& reference, const Points& moving, const Eigen::Vector3d& motion,
                          double maxDistance) {
  std::vector<int> numbers(moving.size(), -1);
  // <solution partners>
  const double c = std::cos(motion[2]), s = std::sin(motion[2]);
  for (std::size_t k = 0; k < moving.size(); ++k) {
    const double x = motion[0] + c * moving[k].x() - s * moving[k].y();
    const double y = motion[1] + s * moving[k].x() + c * moving[k].y();
    double nearest = maxDistance * maxDistance;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      const double dx = reference[i].x() - x, dy = reference[i].y() - y, squared = dx * dx + dy * dy;
      if (squared > nearest) continue;
      nearest = squared;
      numbers[k] = static_cast<int>(i);
    }
  }
  // <todo>
  //| // TODO: take each point along with the motion, and look for the nearest.
  // </solution>
  return numbers;
}

Eigen::Vector3d bestMotion(const Points& from, const Points& to) {
  // <solution bestMotion>
  Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = a;  // the means
  for (std::size_t k = 0; k < from.size(); ++k) {
    a += from[k];
    b += to[k];
  }
  a /= static_cast<double>(from.size());
  b /= static_cast<double>(from.size());
  double along = 0, across = 0;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const Eigen::Vector2d p = from[k] - a, q = to[k] - b;
    along += p.x() * q.x() + p.y() * q.y();
    across += p.x() * q.y() - p.y() * q.x();
  }
  const double turn = std::atan2(across, along), c = std::cos(turn), s = std::sin(turn);
  return {b.x() - c * a.x() + s * a.y(), b.y() - s * a.x() - c * a.y(), turn};
  // <todo>
  //| // TODO: the means first. Around them, which angle turns one set of points onto the other best?
  //| return Eigen::Vector3d::Zero();
  // </solution>
}

Aligned aligned(const Points& reference, const Points& moving, const Eigen::Vector3d& guess) {
  Aligned result{guess, 0, 0};
  // <solution aligned>
  for (int iteration = 0; iteration < 60; ++iteration) {
    // Partners far away help at first; later they only pull at what is hidden from the other scan.
    const double reach = std::max(0.3, 0.6 * std::pow(0.9, iteration));
    const std::vector<int> numbers = partners(reference, moving, result.motion, reach);
    Points from, to;
    for (std::size_t k = 0; k < moving.size(); ++k)
      if (numbers[k] >= 0) {
        from.push_back(moving[k]);
        to.push_back(reference[static_cast<std::size_t>(numbers[k])]);
      }
    if (from.size() < 3) break;
    const Eigen::Vector3d before = result.motion;
    result.motion = bestMotion(from, to);
    double squares = 0;
    const double c = std::cos(result.motion[2]), s = std::sin(result.motion[2]);
    for (std::size_t k = 0; k < from.size(); ++k)
      squares += std::pow(result.motion[0] + c * from[k].x() - s * from[k].y() - to[k].x(), 2) +
                 std::pow(result.motion[1] + s * from[k].x() + c * from[k].y() - to[k].y(), 2);
    result.residual = std::sqrt(squares / static_cast<double>(from.size()));
    result.overlap = static_cast<double>(from.size()) / static_cast<double>(moving.size());
    if (reach == 0.3 && (result.motion - before).norm() < 1e-6) break;
  }
  // <todo>
  //| // TODO: partners, then the best motion for them. Once is not enough.
  // </solution>
  return result;
}

std::optional<Eigen::Vector3d> loopMotion(const Points& reference, const Points& moving,
                                          const Eigen::Vector3d& guess) {
  // <solution loopMotion>
  const Aligned there = aligned(reference, moving, guess);
  const Eigen::Vector3d backGuess = seenFrom(guess, Eigen::Vector3d::Zero());
  const Aligned back = aligned(moving, reference, backGuess);
  const Eigen::Vector3d both = seenFrom(seenFrom(back.motion, Eigen::Vector3d::Zero()), there.motion);
  if (std::min(there.overlap, back.overlap) < 0.8 || there.residual > 0.11) return {};
  if (std::hypot(both[0], both[1]) > 0.1 || std::abs(both[2]) > 0.05) return {};
  return there.motion;
  // <todo>
  //| // TODO: what do overlap and residual say, and what if you exchange the two scans?
  //| return {};
  // </solution>
}

std::vector<Eigen::Vector3d> robustlyAdjusted(const PoseMap& map) {
  PoseMap now = map;
  // <solution robustlyAdjusted>
  // Geman and McClure's weights, first with a reach so wide that all loops count, then narrower and narrower.
  constexpr double kBound = 16;  // of e^T Omega e: of right edges, one in a thousand has more
  std::vector<double> weights(map.edges.size(), 1), squares(map.edges.size(), 0);
  double reach = 0;
  for (int round = 0; round < 60; ++round) {
    double widest = 0;
    for (std::size_t k = 0; k < map.edges.size(); ++k) {
      const MeasuredEdge& edge = map.edges[k];
      if (!edge.isLoop) continue;
      squares[k] = mapCost({now.poses, {edge}});
      widest = std::max(widest, squares[k]);
    }
    reach = round == 0 ? std::max(kBound, widest) : std::max(kBound, reach / 1.4);
    for (std::size_t k = 0; k < map.edges.size(); ++k)
      weights[k] = map.edges[k].isLoop ? std::pow(reach / (reach + squares[k]), 2) : 1;
    now.poses = moved(now.poses, gaussNewtonStep(now, weights, 0));
  }
  // <todo>
  //| // TODO: weigh each loop by how well it fits, adjust, and weigh again. All loops are wide of the mark at
  //| // first: who is wrong?
  // </solution>
  return now.poses;
}

// <solution conditioning>
// The points with a 1 below each, n columns.
Eigen::MatrixXd homogeneous(const Eigen::MatrixXd& points) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Ones(points.rows() + 1, points.cols());
  all.topRows(points.rows()) = points;
  return all;
}

// Moves the mean of the points to zero and scales their mean distance from there to sqrt(dimension).
Eigen::MatrixXd conditioning(const Eigen::MatrixXd& points) {
  const Eigen::Index d = points.rows();
  const Eigen::VectorXd mean = points.rowwise().mean();
  const double distance = (points.colwise() - mean).colwise().norm().mean();
  Eigen::MatrixXd T = Eigen::MatrixXd::Identity(d + 1, d + 1);
  T.topLeftCorner(d, d) *= std::sqrt(static_cast<double>(d)) / distance;
  T.topRightCorner(d, 1) = -T(0, 0) * mean;
  return T;
}

// The twelve numbers of P, row by row.
Projection fromNumbers(const Eigen::VectorXd& p) {
  Projection P;
  for (int row = 0; row < 3; ++row) P.row(row) = p.segment<4>(4 * row).transpose();
  return P;
}
// <todo>
// </solution>

Projection projectionFromPoints(const Eigen::Matrix3Xd& points, const Eigen::Matrix2Xd& pixels) {
  // <solution projectionFromPoints>
  const Eigen::MatrixXd T = conditioning(points), U = conditioning(pixels);
  const Eigen::MatrixXd X = T * homogeneous(points), x = U * homogeneous(pixels);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * X.cols(), 12);
  for (Eigen::Index i = 0; i < X.cols(); ++i)
    for (int row = 0; row < 2; ++row) {
      A.block<1, 4>(2 * i + row, 4 * row) = X.col(i).transpose();
      A.block<1, 4>(2 * i + row, 8) = -x(row, i) * X.col(i).transpose();
    }
  const Eigen::MatrixXd P = fromNumbers(svd(A).V.col(11));
  return inverse(U) * P * T;
  // <todo>
  //| // TODO: two linear equations for each point. Which P of length 1 fits them best?
  //| return Projection::Zero();
  // </solution>
}

Eigen::Matrix2Xd reprojectionErrors(const Projection& P, const Eigen::Matrix3Xd& points,
                                    const Eigen::Matrix2Xd& pixels) {
  Eigen::Matrix2Xd errors = Eigen::Matrix2Xd::Zero(2, points.cols());
  // <solution reprojectionErrors>
  for (int point = 0; point < points.cols(); ++point) {
    const Eigen::Vector3d seen = P.leftCols<3>() * points.col(point) + P.col(3);
    errors.col(point) = seen.head<2>() / seen[2] - pixels.col(point);
  }
  // <todo>
  //| // TODO: the third number of P (X, 1) is the depth.
  // </solution>
  return errors;
}

Projection refined(const Projection& P, const Eigen::Matrix3Xd& points, const Eigen::Matrix2Xd& pixels) {
  Projection best = P;
  // <solution refined>
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2 * points.cols(), 12);
  for (int k = 0; k < 50; ++k) {
    best /= best.norm();
    for (int point = 0; point < points.cols(); ++point) {
      Eigen::Vector4d X;
      X << points.col(point), 1;
      const Eigen::Vector3d seen = best * X;
      for (int row = 0; row < 2; ++row) {
        J.block<1, 4>(2 * point + row, 4 * row) = X.transpose() / seen[2];
        J.block<1, 4>(2 * point + row, 8) = -seen[row] / (seen[2] * seen[2]) * X.transpose();
      }
    }
    // J has no effect along P itself. Of all solutions the shortest is the one without a part along it.
    const Eigen::VectorXd e = reprojectionErrors(best, points, pixels).reshaped();
    const Eigen::VectorXd step = leastSquares(J, -e);
    best += fromNumbers(step);
    if (step.norm() < 1e-12) break;
  }
  // <todo>
  //| // TODO: Gauss-Newton steps in the twelve numbers of P. Which change of P changes no pixel?
  // </solution>
  return best;
}

Eigen::Vector3d cameraPosition(const Projection& P) {
  // <solution cameraPosition>
  return -solve(P.leftCols<3>(), P.col(3));
  // <todo>
  //| // TODO: P (p, 1) = 0.
  //| return Eigen::Vector3d::Zero();
  // </solution>
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

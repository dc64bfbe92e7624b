#include <algorithm>
#include <cmath>
#include <numbers>

#include "estimation/pose_graph.h"
#include "exercise.h"
#include "map_pictures.h"
#include "rooms.h"

using namespace rex;

// Keeps the compiler quiet about what a function below does not use yet.
template <class... Unused>
void notUsedYet(const Unused&...) {}

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
  //| notUsedYet(a, b);
  //| return Eigen::Vector3d::Zero();
  // </solution>
}

Eigen::Vector3d edgeError(const Eigen::Vector3d& i, const Eigen::Vector3d& j, const Eigen::Vector3d& z) {
  // <solution edgeError>
  return seenFrom(z, seenFrom(i, j));
  // <todo>
  //| // TODO: what is j, seen from i? And that, seen from z?
  //| notUsedYet(i, j, z);
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
  //| notUsedYet(i, j, z);
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
  //| notUsedYet(map);
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
  //| notUsedYet(weights);
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
  //| notUsedYet(map, weights, damping);
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
  //| notUsedYet(reference, motion, maxDistance);
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
  //| notUsedYet(from, to);
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
  //| notUsedYet(reference, moving);
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
  //| notUsedYet(reference, moving, guess);
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

// From here on everything is given: all parts one after another, with pictures. Change it as you like.

namespace {

const Eigen::Vector3d kDeviations(0.05, 0.05, 0.03);  // of a step of odometry: m, m, rad

Eigen::Matrix3d informationOf(double way, double turn) {
  return Eigen::Vector3d(1 / (way * way), 1 / (way * way), 1 / (turn * turn)).asDiagonal();
}

// The pose that, seen from a, is b.
Eigen::Vector3d onward(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector2d p = pointFrom(a, {b[0], b[1]});
  return {p.x(), p.y(), std::remainder(a[2] + b[2], 2 * std::numbers::pi)};
}

void showAlignment(const Walk& walk) {
  const Points &reference = walk.scans[7], &moving = walk.scans[9];
  const Eigen::Vector3d guess(1.6, 0.25, 0.2);
  const Aligned match = aligned(reference, moving, guess);
  Figure figure = planOf("Two scans: as guessed, and aligned");
  const Eigen::Vector3d here = Eigen::Vector3d::Zero();
  figure.series = {cloud("reference", {here}, {reference}, kBlack),
                   cloud("as guessed", {guess}, {moving}, kGrey),
                   cloud("aligned", {match.motion}, {moving}, kRed)};
  for (Series& series : figure.series) series.size = 0.7;
  plot("scans", figure);
  print("residual [m] and overlap of two scans", Eigen::RowVector2d(match.residual, match.overlap));
}

// Odometry with noise, replaced by what the scans say where they agree with it.
PoseMap mapOfWalk(const Walk& walk, Rng& rng) {
  PoseMap map{{walk.truth.front()}, {}};
  for (std::size_t k = 1; k < walk.truth.size(); ++k) {
    const Eigen::Vector3d &a = walk.truth[k - 1], &b = walk.truth[k];
    const double c = std::cos(a[2]), s = std::sin(a[2]), x = b[0] - a[0], y = b[1] - a[1];
    const Eigen::Vector3d odometry =
        Eigen::Vector3d(c * x + s * y, c * y - s * x, std::remainder(b[2] - a[2], 2 * std::numbers::pi)) +
        kDeviations.cwiseProduct(rng.normalVector(3));
    map.poses.push_back(onward(map.poses.back(), odometry));
    const Aligned match = aligned(walk.scans[k - 1], walk.scans[k], odometry);
    const Eigen::Vector3d apart = match.motion - odometry;
    const bool doAgree =
        std::hypot(apart[0], apart[1]) < 0.2 && std::abs(apart[2]) < 0.12 && match.overlap > 0.7;
    map.edges.push_back({static_cast<int>(k) - 1, static_cast<int>(k), doAgree ? match.motion : odometry,
                         doAgree ? informationOf(0.03, 0.015) : informationOf(0.05, 0.03)});
  }
  return map;
}

// Tries pairs of poses that may be near each other, from guesses around what the edges so far say.
void closeLoops(PoseMap& map, const std::vector<Points>& scans) {
  Poses chain{map.poses.front()};
  for (const MeasuredEdge& edge : map.edges) chain.push_back(onward(chain.back(), edge.motion));
  for (std::size_t j = 0; j < chain.size(); j += 2)
    for (std::size_t i = 0; i + 15 < j; i += 2) {
      const Eigen::Vector3d guess = seenFrom(chain[i], chain[j]);
      if (std::hypot(chain[j][0] - chain[i][0], chain[j][1] - chain[i][1]) > 1.8) continue;
      std::optional<Eigen::Vector3d> motion;
      for (const double dx : {0., -0.4, 0.4})
        for (const double dy : {0., -0.4, 0.4})
          if (!motion) motion = loopMotion(scans[i], scans[j], guess + Eigen::Vector3d(dx, dy, 0));
      if (motion)
        map.edges.push_back(
            {static_cast<int>(i), static_cast<int>(j), *motion, informationOf(0.03, 0.015), true});
    }
}

void showMaps(const Walk& walk, const PoseMap& map, const Poses& best, const Poses& byLibrary) {
  Figure before = planOf("By odometry alone: the scans where it says the robot was");
  before.series = {cloud("scans", map.poses, walk.scans, kGrey), wayOf("way", map.poses, kBlue)};
  addLoops(before, map, map.poses, kRed);
  plot("before", before);
  Figure after = planOf("Adjusted");
  after.series = {cloud("scans", best, walk.scans, kGrey), wayOf("way", best, kBlue)};
  addLoops(after, map, best, kRed);
  after.series.push_back(wayOf("library", byLibrary, kBlack, true));
  plot("after", after);
}

void showCosts(const PoseMap& map, double least) {
  const std::vector<double> costs = adjusted(map).costs;
  Series series{.label = "yours", .style = SeriesStyle::kLinesPoints};
  for (std::size_t k = 0; k < costs.size(); ++k) {
    series.x.push_back(static_cast<double>(k));
    series.y.push_back(std::max(costs[k], 1e-3));
  }
  const Series library{.label = "least, by the library",
                       .x = {0, series.x.back()},
                       .y = {std::max(least, 1e-3), std::max(least, 1e-3)},
                       .dashed = true,
                       .color = kBlack};
  plot("costs", {.title = "Cost of the map",
                 .xLabel = "steps [1]",
                 .yLabel = "cost [1]",
                 .logY = true,
                 .series = {series, library}});
}

void showFilm(const Walk& walk, const PoseMap& map) {
  PoseMap now = map;
  std::vector<Poses> steps{now.poses};
  for (int k = 0; k < 3; ++k) {
    const Eigen::VectorXd step = gaussNewtonStep(now, std::vector<double>(map.edges.size(), 1), 0);
    for (std::size_t i = 0; i < now.poses.size(); ++i)
      now.poses[i] += step.segment<3>(3 * static_cast<Eigen::Index>(i));
    steps.push_back(now.poses);
  }
  filmOf("adjusting", walk.scans, steps);
}

// Some loops that join places metres apart, as if a room looked like another.
void showWrongLoops(const Walk& walk, PoseMap map) {
  const int last = static_cast<int>(map.poses.size()) - 1;
  for (const auto& [i, j] : {std::pair{5, 30}, {12, 40}, {20, last - 5}})
    map.edges.push_back({i, j, Eigen::Vector3d(0.1, 0.1, 0), informationOf(0.03, 0.015), true});
  Figure figure = planOf("The same with three wrong loops");
  figure.series = {wayOf("truth", walk.truth, kGrey), wayOf("all loops trusted", adjusted(map).poses, kRed),
                   wayOf("robust", robustlyAdjusted(map), kBlue)};
  figure.series[0].size = 4;
  plot("wrongLoops", figure);
}

}  // namespace

int main() {
  Rng rng(8);
  const Walk walk = walkThroughHouse(rng);
  showAlignment(walk);
  PoseMap map = mapOfWalk(walk, rng);
  closeLoops(map, walk.scans);
  print("poses, edges",
        Eigen::RowVector2d(static_cast<double>(map.poses.size()), static_cast<double>(map.edges.size())));

  // The library on the same graph: once your own functions work, its way lies on yours.
  PlanarPoseGraph graph{Eigen::Matrix3Xd(3, static_cast<Eigen::Index>(map.poses.size())), {}};
  for (std::size_t k = 0; k < map.poses.size(); ++k)
    graph.poses.col(static_cast<Eigen::Index>(k)) = map.poses[k];
  for (const MeasuredEdge& edge : map.edges)
    graph.edges.push_back({edge.from, edge.to, edge.motion, edge.information});
  const double least = optimize(graph).cost;
  Poses byLibrary;
  for (std::size_t k = 0; k < map.poses.size(); ++k)
    byLibrary.emplace_back(graph.poses.col(static_cast<Eigen::Index>(k)));

  showMaps(walk, map, adjusted(map).poses, byLibrary);
  showCosts(map, least);
  showFilm(walk, map);
  showWrongLoops(walk, map);
}

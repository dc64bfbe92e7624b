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
  // TODO: angles that differ by whole turns are one and the same.
  return angle;
}

Eigen::Vector3d seenFrom(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  // TODO: the way from a to b, in the axes of a.
  notUsedYet(a, b);
  return Eigen::Vector3d::Zero();
}

Eigen::Vector3d edgeError(const Eigen::Vector3d& i, const Eigen::Vector3d& j, const Eigen::Vector3d& z) {
  // TODO: what is j, seen from i? And that, seen from z?
  notUsedYet(i, j, z);
  return Eigen::Vector3d::Zero();
}

EdgeJacobians edgeJacobians(const Eigen::Vector3d& i, const Eigen::Vector3d& j, const Eigen::Vector3d& z) {
  EdgeJacobians jacobians;
  // TODO: both rotations together are one, by heading i + heading z. What does each number of i move?
  notUsedYet(i, j, z);
  return jacobians;
}

double mapCost(const PoseMap& map) {
  double cost = 0;
  // TODO: e^T Omega e of each edge.
  notUsedYet(map);
  return cost;
}

NormalEquations normalEquations(const PoseMap& map, const std::vector<double>& weights) {
  NormalEquations equations{{}, Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(map.poses.size()))};
  // TODO: each edge adds to four blocks of H, and to two of b.
  notUsedYet(weights);
  return equations;
}

Eigen::VectorXd gaussNewtonStep(const PoseMap& map, const std::vector<double>& weights, double damping) {
  Eigen::VectorXd step = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(map.poses.size()));
  // TODO: solveSparse() solves H x = b. But H says nothing about where the map as a whole lies.
  notUsedYet(map, weights, damping);
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
  notUsedYet(reference, motion, maxDistance);
  return numbers;
}

Eigen::Vector3d bestMotion(const Points& from, const Points& to) {
  // TODO: the means first. Around them, which angle turns one set of points onto the other best?
  notUsedYet(from, to);
  return Eigen::Vector3d::Zero();
}

Aligned aligned(const Points& reference, const Points& moving, const Eigen::Vector3d& guess) {
  Aligned result{guess, 0, 0};
  // TODO: partners, then the best motion for them. Once is not enough.
  notUsedYet(reference, moving);
  return result;
}

std::optional<Eigen::Vector3d> loopMotion(const Points& reference, const Points& moving,
                                          const Eigen::Vector3d& guess) {
  // TODO: what do overlap and residual say, and what if you exchange the two scans?
  notUsedYet(reference, moving, guess);
  return {};
}

std::vector<Eigen::Vector3d> robustlyAdjusted(const PoseMap& map) {
  PoseMap now = map;
  // TODO: weigh each loop by how well it fits, adjust, and weigh again. All loops are wide of the mark at
  // first: who is wrong?
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

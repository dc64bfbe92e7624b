#include "show.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <utility>

#include "camera_pictures.h"
#include "course/vision_simulator.h"
#include "estimation/pose_graph.h"
#include "map_pictures.h"

using namespace rex;

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

// Where a robot came to, seen from where it had been.
Eigen::Vector3d trueMotion(const Walk& walk, std::size_t before, std::size_t after) {
  const auto frameOf = [](const Eigen::Vector3d& x) {
    return Eigen::Isometry2d(Eigen::Translation2d(x[0], x[1]) * Eigen::Rotation2Dd(x[2]));
  };
  const Eigen::Isometry2d motion = frameOf(walk.truth[before]).inverse() * frameOf(walk.truth[after]);
  return {motion.translation().x(), motion.translation().y(), Eigen::Rotation2Dd(motion.linear()).angle()};
}

// Odometry with noise, replaced by what the scans say if they agree with it.
PoseMap mapOfWalk(const Walk& walk, Rng& rng) {
  PoseMap map{{walk.truth.front()}, {}};
  for (std::size_t k = 1; k < walk.truth.size(); ++k) {
    const Eigen::Vector3d odometry =
        trueMotion(walk, k - 1, k) + kDeviations.cwiseProduct(rng.normalVector(3));
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

// Odometry with noise, and a loop between every third pose and those it came near to, with noise as well.
PoseMap mapOfTruth(const Walk& walk) {
  Rng rng(5);
  PoseMap map{{walk.truth.front()}, {}};
  for (std::size_t j = 1; j < walk.truth.size(); ++j) {
    const auto add = [&](std::size_t i, bool isLoop) {
      map.edges.push_back({static_cast<int>(i), static_cast<int>(j),
                           trueMotion(walk, i, j) + kDeviations.cwiseProduct(rng.normalVector(3)),
                           informationOf(kDeviations[0], kDeviations[2]), isLoop});
    };
    add(j - 1, false);
    map.poses.push_back(onward(map.poses.back(), map.edges.back().motion));
    for (std::size_t i = 0; i + 15 < j; ++i)
      if (j % 3 == 0 && (walk.truth[j] - walk.truth[i]).head<2>().norm() < 1) add(i, true);
  }
  return map;
}

struct Optimum {
  Poses poses;
  double costBefore = 0, cost = 0;
};

// The library on the same graph: once your own functions work, its way lies on yours.
Optimum byLibrary(const PoseMap& map) {
  const auto n = static_cast<Eigen::Index>(map.poses.size());
  PlanarPoseGraph copy{.poses = Eigen::Matrix3Xd(3, n)};
  for (Eigen::Index k = 0; k < n; ++k) copy.poses.col(k) = map.poses[static_cast<std::size_t>(k)];
  for (const MeasuredEdge& e : map.edges) copy.edges.push_back({e.from, e.to, e.motion, e.information});
  const PoseGraphResult result = optimize(copy);
  Optimum best{{}, result.initialCost, result.cost};
  for (Eigen::Index k = 0; k < n; ++k) best.poses.emplace_back(copy.poses.col(k));
  return best;
}

// The poses after one of your steps.
Poses stepped(const PoseMap& map) {
  const Eigen::VectorXd step = gaussNewtonStep(map, std::vector<double>(map.edges.size(), 1), 0);
  Poses poses = map.poses;
  for (std::size_t i = 0; i < poses.size(); ++i)
    poses[i] += step.segment<3>(3 * static_cast<Eigen::Index>(i));
  return poses;
}

void plotCosts(const std::vector<double>& costs, double least) {
  Series series{.label = "yours", .style = SeriesStyle::kLinesPoints};
  for (std::size_t k = 0; k < costs.size(); ++k) series.add(static_cast<double>(k), std::max(costs[k], 1e-3));
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

double rmsOf(const Eigen::Matrix2Xd& errors) {
  return errors.norm() / std::sqrt(static_cast<double>(errors.cols()));
}

// Where pictures of the same points, each with noise of its own, put the camera.
void plotCameras(VisionSimulator& simulator, const Eigen::Matrix4Xd& points) {
  const Eigen::Matrix3Xd known = points.topRows(3);
  const Eigen::Vector3d truth = simulator.getCameraPose().p;
  std::vector<Eigen::Vector3d> found;
  for (int k = 0; k < 100; ++k) {
    const Eigen::Matrix2Xd pixels = simulator.projectWorldPoints(points).topRows(2);
    found.push_back(cameraPosition(refined(projectionFromPoints(known, pixels), known, pixels)));
  }
  Figure figure = planOf("A hundred pictures of the same points: where they put the camera, from above");
  figure.series = {
      {.label = "line of sight", .x = {0, 1.3 * truth.x()}, .y = {0, 1.3 * truth.y()}, .color = kGrey},
      dots(known, {.label = "points", .size = .5, .color = kGrey}),
      dots(found, {.label = "refined", .size = .5, .color = kBlue}),
      dots(truth, {.label = "camera", .marker = Marker::kCross, .size = 2, .color = kRed})};
  plot("cameras", figure);
}

}  // namespace

void showEdge(const Eigen::Vector3d& i, const Eigen::Vector3d& motion, const Eigen::Vector3d& z) {
  const Eigen::Vector3d j = onward(i, motion);
  if (seenFrom(i, j).isZero()) return nothingYet("an edge");
  const auto report = [](const char* what, const Eigen::Vector3d& x) {
    std::printf("%s: (%.4f, %.4f, %.4f)\n", what, x[0], x[1], x[2]);
  };
  report("pose j seen from i", seenFrom(i, j));
  report("  it should be", motion);
  report("error of an edge that measured this, which should be 0", edgeError(i, j, motion));
  report("error of one that measured something else", edgeError(i, j, z));
  const EdgeJacobians jacobians = edgeJacobians(i, j, z);
  Eigen::MatrixXd J(3, 6);
  J << jacobians.byI, jacobians.byJ;
  Eigen::VectorXd both(6);
  both << i, j;
  const VectorFunction f = [&](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(edgeError(x.head<3>(), x.tail<3>(), z));
  };
  std::printf("edgeJacobians(): %s\n", checkJacobian(f, J, both).message.c_str());
}

void showGivenLoops(const Walk& walk) {
  const PoseMap map = mapOfTruth(walk);
  const Optimum library = byLibrary(map);
  const Poses after = stepped(map);
  if (mapCost(map) == 0) return nothingYet("the graph");
  std::printf("cost by odometry %.3f, by the library %.3f\n", mapCost(map), library.costBefore);
  std::printf("cost after a step %.3f, after many %.3f, least by the library %.3f\n",
              mapCost({after, map.edges}), adjusted(map).costs.back(), library.cost);
  Figure figure = planOf("Odometry and given loops");
  figure.series = {pathSeries("odometry", map.poses, kGrey), pathSeries("after one step", after, kRed)};
  addLoops(figure, map, map.poses, kGrey);
  if (const Poses best = adjusted(map).poses; best != map.poses)
    figure.series.push_back(pathSeries("adjusted", best, kBlue));
  figure.series.push_back(pathSeries("library", library.poses, kBlack, true));
  plot("graph", figure);
}

void showAlignment(const Points& reference, const Points& moving, const Eigen::Vector3d& guess) {
  const Aligned match = aligned(reference, moving, guess);
  if (match.overlap == 0) return nothingYet("two scans");
  Figure figure = planOf("Two scans: as guessed, and aligned");
  const Eigen::Vector3d here = Eigen::Vector3d::Zero();
  figure.series = {cloud("reference", {here}, {reference}, kBlack),
                   cloud("as guessed", {guess}, {moving}, kGrey),
                   cloud("aligned", {match.motion}, {moving}, kRed)};
  for (Series& series : figure.series) series.size = 0.7;
  plot("scans", figure);
  print("residual [m] and overlap of two scans", Eigen::RowVector2d(match.residual, match.overlap));
}

PoseMap mapFromScans(const Walk& walk, Rng& rng) {
  PoseMap map = mapOfWalk(walk, rng);
  closeLoops(map, walk.scans);
  return map;
}

void showMap(const Walk& walk, const PoseMap& map) {
  if (map.edges.size() < map.poses.size()) return nothingYet("loops");
  print("poses, edges",
        Eigen::RowVector2d(static_cast<double>(map.poses.size()), static_cast<double>(map.edges.size())));
  const Optimum library = byLibrary(map);
  const Adjusted best = adjusted(map);
  Figure before = planOf("By odometry alone: the scans where it says the robot was");
  before.series = {cloud("scans", map.poses, walk.scans, kGrey), pathSeries("path", map.poses, kBlue)};
  addLoops(before, map, map.poses, kRed);
  plot("before", before);
  Figure after = planOf("Adjusted");
  after.series = {cloud("scans", best.poses, walk.scans, kGrey), pathSeries("path", best.poses, kBlue)};
  addLoops(after, map, best.poses, kRed);
  after.series.push_back(pathSeries("library", library.poses, kBlack, true));
  plot("after", after);
  plotCosts(best.costs, library.cost);

  std::vector<Poses> steps{map.poses};
  for (int k = 0; k < 3; ++k) steps.push_back(stepped({steps.back(), map.edges}));
  filmOf("adjusting", walk.scans, steps);
}

void showWrongLoops(const Walk& walk, PoseMap map) {
  const int last = static_cast<int>(map.poses.size()) - 1;
  for (const auto& [i, j] : {std::pair{5, 30}, {12, 40}, {20, last - 5}})
    map.edges.push_back({i, j, Eigen::Vector3d(0.1, 0.1, 0), informationOf(0.03, 0.015), true});
  const Poses robust = robustlyAdjusted(map);
  if (robust == map.poses) return nothingYet("wrong loops");
  Figure figure = planOf("The same with three wrong loops");
  figure.series = {pathSeries("truth", walk.truth, kGrey),
                   pathSeries("all loops trusted", adjusted(map).poses, kRed),
                   pathSeries("robust", robust, kBlue)};
  figure.series[0].size = 4;
  plot("wrongLoops", figure);
}

void showCalibration(int points) {
  VisionSimulator simulator(4);
  const Eigen::Matrix4Xd world = simulator.getRandomWorldPoints(points);
  const Eigen::Matrix3Xd known = world.topRows(3);
  const Eigen::Matrix2Xd pixels = simulator.projectWorldPoints(world).topRows(2);
  const Projection linear = projectionFromPoints(known, pixels);
  if (linear.isZero() || reprojectionErrors(linear, known, pixels).isZero()) return nothingYet("the camera");
  const Eigen::Matrix2Xd errors = reprojectionErrors(refined(linear, known, pixels), known, pixels);
  std::printf("root mean square error: %.5f pixels by projectionFromPoints(), %.5f refined\n",
              rmsOf(reprojectionErrors(linear, known, pixels)), rmsOf(errors));
  char title[80];
  std::snprintf(title, sizeof title, "Reprojection: root mean square error %.2f pixels", rmsOf(errors));
  plot("reprojection", reprojection(title, pixels, errors, 20));
  plotCameras(simulator, world);
}

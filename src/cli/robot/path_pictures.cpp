#include "cli/robot/path_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "cli/robot/coordinate_names.h"
#include "cli/terminal.h"
#include "collision/contact_batch.h"
#include "kinematics/pose_batch.h"
#include "render/scene_picture.h"

namespace rex::cli {
namespace {

using Eigen::Vector3d;

constexpr Eigen::Index kBatch = 1024;  // postures at a time, so that their poses take little memory
const Color kPathColor{0.84f, 0.37f, 0.0f};
const std::array<Color, 2> kGraphColors = {Color{0.0f, 0.45f, 0.70f}, Color{0.0f, 0.62f, 0.45f}};

// The position of a body's origin in each posture.
std::vector<Vector3d> placesOf(const Model& model, BodyId body, const MatrixArg& postures) {
  std::vector<Vector3d> places;
  PoseBatch poses;
  for (Eigen::Index first = 0; first < postures.cols(); first += kBatch) {
    const Eigen::Index count = std::min(kBatch, postures.cols() - first);
    forwardKinematicsBatch(model, postures.middleCols(first, count), poses);
    for (int k = 0; k < static_cast<int>(count); ++k) places.push_back(poses.pose(body, k).p);
  }
  return places;
}

// Length of the straight pieces of drawn edges, in the metric of the space; longer for very many edges.
double pieceLength(const Space& space, const std::vector<PathGraph>& graphs) {
  constexpr double kFine = 0.15, kMostPieces = 60'000;
  double whole = 0;
  for (const PathGraph& graph : graphs)
    for (const auto& [a, b] : graph.edges) whole += space.distance(graph.nodes.col(a), graph.nodes.col(b));
  return std::max(kFine, whole / kMostPieces);
}

// Postures from a to b, both included, no further apart than `piece`.
Eigen::MatrixXd pointsBetween(const Space& space, const VectorArg& a, const VectorArg& b, double piece) {
  const int pieces = std::max(1, static_cast<int>(std::ceil(space.distance(a, b) / piece)));
  Eigen::MatrixXd points(a.size(), pieces + 1);
  for (int i = 0; i <= pieces; ++i) space.interpolate(a, b, static_cast<double>(i) / pieces, points.col(i));
  return points;
}

// Very many lines are drawn so faint that what lies behind them shows through.
float opacityOf(std::size_t edges) { return std::clamp(800 / static_cast<float>(edges), 0.08f, 0.5f); }

LineSet linesOf(const Model& model, const Space& space, BodyId body, const PathGraph& graph, double piece) {
  LineSet lines;
  for (const auto& [a, b] : graph.edges) {
    const std::vector<Vector3d> places =
        placesOf(model, body, pointsBetween(space, graph.nodes.col(a), graph.nodes.col(b), piece));
    for (std::size_t i = 1; i < places.size(); ++i) lines.segments.emplace_back(places[i - 1], places[i]);
  }
  return lines;
}

Polyline wayOf(const Model& model, const Space& space, BodyId body, const MatrixArg& path) {
  constexpr double kFine = 0.03, kMostPieces = 60'000;
  const double piece = std::max(kFine, pathLength(space, path) / kMostPieces);
  Polyline way{.color = kPathColor, .width = 5};
  for (Eigen::Index k = 1; k < path.cols(); ++k)
    for (const Vector3d& place :
         placesOf(model, body, pointsBetween(space, path.col(k - 1), path.col(k), piece)))
      way.points.push_back(place);
  return way;
}

// Adds the moving solids once more, faintly, in the posture of the other picture.
void addFaintly(Picture& picture, const Picture& other) {
  constexpr float kFaint = 0.45f;
  const std::size_t count = picture.solids.size();
  for (std::size_t i = 0; i < count; ++i) {
    Solid solid = other.solids[i];
    const Pose &here = picture.solids[i].X_WS, &there = solid.X_WS;
    if (here.p.isApprox(there.p, 1e-9) && here.R.isApprox(there.R, 1e-9)) continue;
    solid.color.a *= kFaint;
    picture.solids.push_back(std::move(solid));
  }
}

}  // namespace

BodyId farthestBody(const Model& model) {
  std::vector<int> movers(model.bodies().size(), 0);
  std::size_t farthest = 0;
  for (std::size_t i = 1; i < movers.size(); ++i) {  // parents come first
    const Body& body = model.bodies()[i];
    const bool moves = body.joint != kNoJoint && model[body.joint].nv > 0;
    movers[i] = movers[static_cast<std::size_t>(body.parent)] + (moves ? 1 : 0);
    if (movers[i] > movers[farthest]) farthest = i;
  }
  return BodyId(static_cast<int>(farthest));
}

Picture exploredPicture(const PathTask& task, BodyId body, const FoundPath& found) {
  const auto& [model, contacts, problem] = task;
  Picture picture = pictureOf(model, forwardKinematics(model, problem.start));
  addFaintly(picture, pictureOf(model, forwardKinematics(model, problem.goal)));
  const double piece = pieceLength(problem.space, found.explored);
  for (std::size_t i = 0; i < found.explored.size(); ++i) {
    picture.lineSets.push_back(linesOf(model, problem.space, body, found.explored[i], piece));
    picture.lineSets.back().color = kGraphColors[i % kGraphColors.size()];
    picture.lineSets.back().color.a = opacityOf(found.explored[i].edges.size());
  }
  if (found.isFound()) picture.polylines.push_back(wayOf(model, problem.space, body, found.path));
  Eigen::MatrixXd ends(problem.start.size(), 2);
  ends << problem.start, problem.goal;
  picture.pointSets.push_back({.points = placesOf(model, body, ends), .color = kPathColor, .size = 11});
  return picture;
}

Figure jointsFigure(const Model& model, const Motion& motion) {
  Figure figure{
      .title = "joints", .xLabel = "time [s]", .yLabel = "position [rad, m]", .legend = Legend::kOutside};
  const std::vector<std::string> names = printablePositionNames(model);
  for (std::size_t i = 0; i < names.size(); ++i) {
    Series series{.label = names[i], .x = motion.times};
    for (const Eigen::VectorXd& q : motion.postures) series.y.push_back(q[static_cast<Eigen::Index>(i)]);
    figure.series.push_back(std::move(series));
  }
  return figure;
}

Figure speedsFigure(const TimedPath& timed, const MotionLimits& limits) {
  constexpr int kPoints = 600;  // about as many as a figure has columns
  Figure figure{.title = "speeds",
                .xLabel = "time [s]",
                .yLabel = "speed / limit [1]",
                .legend = Legend::kOutside,
                .horizontalLines = {{.at = 1, .label = "limit"}}};
  for (const std::string& name : limits.names) figure.series.push_back({.label = harmless(name)});
  for (int i = 0; i <= kPoints; ++i) {
    const double t = timed.duration() * i / kPoints;
    const Eigen::VectorXd v = timed.at(t).v;
    for (std::size_t k = 0; k < figure.series.size(); ++k) {
      const auto joint = static_cast<Eigen::Index>(k);
      figure.series[k].x.push_back(t);
      figure.series[k].y.push_back(std::abs(v[joint]) / limits.velocity[joint]);
    }
  }
  return figure;
}

Figure clearanceFigure(const Model& model, const ContactModel& contacts, const Motion& motion,
                       double margin) {
  Series nearest{.label = "nearest shapes", .x = motion.times};
  PoseBatch poses;
  Eigen::MatrixXd distances;
  for (const Eigen::VectorXd& q : motion.postures) {
    forwardKinematicsBatch(model, q, poses);
    contactDistancesBatch(contacts, poses, distances);
    nearest.y.push_back(distances.minCoeff());
  }
  return {.title = "clearance",
          .xLabel = "time [s]",
          .yLabel = "distance [m]",
          .series = {nearest},
          .horizontalLines = {{.at = margin, .label = "margin"}}};
}

}  // namespace rex::cli

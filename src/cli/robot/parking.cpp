#include "cli/robot/parking.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "cli/robot/path_pictures.h"
#include "cli/terminal.h"
#include "planning/path_clearance.h"
#include "planning/robot_problem.h"

namespace rex::cli {
namespace {

Eigen::MatrixXd posesOf(const Motion& motion) {
  Eigen::MatrixXd poses(3, static_cast<Eigen::Index>(motion.postures.size()));
  for (Eigen::Index k = 0; k < poses.cols(); ++k) poses.col(k) = motion.postures[static_cast<std::size_t>(k)];
  return poses;
}

// The tree with its arcs in short pieces.
PathGraph exploredBy(const Parking& parking) {
  constexpr int kPieces = 3;
  const PathTree& tree = parking.path.driven.found.trees.front();
  PathGraph graph{.nodes = Eigen::MatrixXd(3, (kPieces + 1) * tree.nodes.cols())};
  int count = 0;
  for (std::size_t i = 0; i < tree.parents.size(); ++i) {
    if (tree.parents[i] < 0) continue;
    const Eigen::Vector3d from = tree.nodes.col(tree.parents[i]);
    const auto& [u, seconds] = parking.path.driven.edges[i];
    for (int k = 0; k <= kPieces; ++k, ++count) {
      graph.nodes.col(count) = driveCar(parking.car, from, u, seconds * k / kPieces);
      if (k > 0) graph.edges.emplace_back(count - 1, count);
    }
  }
  graph.nodes.conservativeResize(Eigen::NoChange, count);
  return graph;
}

constexpr double kPosesPerSecond = 100;  // poses per second, and so per metre, of clearances and pictures

}  // namespace

void requireCar(const Model& model) {
  const bool isCar =
      model.nq() == 3 && std::ranges::count(model.joints(), JointType::kPlanarXYPhi, &Joint::type) == 1;
  if (!isCar)
    throw UsageError({.what = harmless(model.name()),
                      .found = fmt::format("{} coordinates", model.nq()),
                      .wanted = "one joint of type transXYPhi, that of the car, and no other that moves"});
}

PathTask parkingTask(Model model, const ContactModel& contacts, const VectorArg& start, const VectorArg& goal,
                     double margin, double resolution) {
  PathProblem problem = robotProblem(model, contacts, start, goal, margin, resolution);
  problem.space = Space::se2(model.lowerLimits().head<2>(), model.upperLimits().head<2>());
  return {std::move(model), contacts, std::move(problem)};
}

Parking parked(const PathTask& task, const Car& car, const HybridAStarOptions& search) {
  Parking parking{.car = car, .path = findCarPath(car, task.problem, search)};
  if (!parking.isFound()) return parking;
  // From pose to pose it drives 1 cm, whose chord is within 0.02 mm of it unless it turns on the spot.
  const Space straight = Space::box(Eigen::Vector3d::Constant(-1e9), Eigen::Vector3d::Constant(1e9));
  parking.clearance = pathClearance(task.model, task.contacts, straight,
                                    posesOf(motionOf(parking, kPosesPerSecond)), kClearanceTolerance);
  return parking;
}

Motion motionOf(const Parking& parking, double rate) {
  const ControlPath& driven = parking.path.driven;
  Motion motion;
  double begin = 0;  // of the control
  for (std::size_t k = 0; k < driven.controls.size(); ++k) {
    const auto& [u, seconds] = driven.controls[k];
    const Eigen::Vector3d from = driven.found.path.col(static_cast<Eigen::Index>(k));
    for (double time = 0;
         time = static_cast<double>(motion.times.size()) / rate, time < begin + seconds - 1e-9;) {
      motion.times.push_back(time);
      motion.postures.emplace_back(driveCar(parking.car, from, u, std::max(0., time - begin)));
    }
    begin += seconds;
  }
  motion.times.push_back(begin);
  motion.postures.emplace_back(driven.found.path.rightCols<1>());
  return motion;
}

Picture parkingPicture(const PathTask& task, const Parking& parking) {
  FoundPath seen{.explored = {exploredBy(parking)}};
  if (parking.isFound()) seen.path = posesOf(motionOf(parking, kPosesPerSecond));
  return exploredPicture(task, farthestBody(task.model), seen);
}

}  // namespace rex::cli

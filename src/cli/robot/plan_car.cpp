#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/numbers.h"
#include "cli/results_internal.h"
#include "cli/robot/motion_files.h"
#include "cli/robot/path_results.h"
#include "cli/robot/path_search.h"
#include "cli/robot/plan.h"
#include "cli/robot/posture_option.h"
#include "cli/robot/scene_option.h"
#include "cli/terminal.h"
#include "collision/collision_pairs.h"
#include "collision/contacts.h"
#include "planning/robot_problem.h"

// `rex plan --planner hybrid-astar`: a car in a scene.

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
    throw UsageError({.what = escapeForTerminal(model.name()),
                      .found = fmt::format("{} coordinates", model.nq()),
                      .wanted = "one joint of type transXYPhi, that of the car, and no other that moves"});
}

PathTask parkingTask(Model model, const ContactModel& contacts, const VectorArg& start, const VectorArg& goal,
                     double margin, double resolution) {
  PathProblem problem = robotProblem(model, contacts, start, goal, margin, resolution);
  problem.space = Space::se2(model.lowerLimits().head<2>(), model.upperLimits().head<2>());
  return {std::move(model), contacts, std::move(problem)};
}

Parking parkCar(const PathTask& task, const Car& car, const HybridAStarOptions& search) {
  Parking parking{.car = car, .path = findCarPath(car, task.problem, search)};
  if (!parking.isFound()) return parking;
  // From pose to pose it drives 1 cm, whose chord is within 0.02 mm of it unless it turns on the spot.
  const Space straight = Space::box(Eigen::Vector3d::Constant(-1e9), Eigen::Vector3d::Constant(1e9));
  parking.clearance = pathClearance(task.model, task.contacts, straight,
                                    posesOf(parkingMotion(parking, kPosesPerSecond)), kClearanceTolerance);
  return parking;
}

Motion parkingMotion(const Parking& parking, double rate) {
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
  if (parking.isFound()) seen.path = posesOf(parkingMotion(parking, kPosesPerSecond));
  return exploredPicture(task, farthestBody(task.model), seen);
}

namespace {

// Otherwise the car would drive through obstacles there without a word.
void tellWhatIsNoObstacle(const Model& model) {
  for (const PairVerdict& pair : pairVerdicts(model))
    if (pair.reason == PairReason::kNeighbours)
      note(wrap(
          fmt::format("shapes of '{}' and '{}' do not stop each other, because a joint links these bodies: "
                      "put obstacles on a body of their own",
                      escapeForTerminal(model[pair.a].name), escapeForTerminal(model[pair.b].name)),
          2, 0));
}

PathTask carTaskOf(Model model, const PlanOptions& options) {
  requireCar(model);
  const ContactModel contacts = sceneContactModel(model);
  const Eigen::VectorXd start = postureWithinLimits(model, "--start", options.start);
  const Eigen::VectorXd goal = postureWithinLimits(model, "--goal", options.goal);
  PathTask task = asWrongUse([&] {
    return parkingTask(std::move(model), contacts, start, goal, *options.margin, *options.resolution);
  });
  requireClearEnds(task, *options.margin);
  tellWhatIsNoObstacle(task.model);
  return task;
}

void writeFiles(const PathTask& task, const Parking& parking, const PlanOptions& options,
                const RenderPlan& pictures, Results& results) {
  constexpr double kRate = 100;
  const std::string title = escapeForTerminal(task.model.name()) + ", hybrid A*";
  const CarPath& path = parking.path;
  writeExplored(parkingPicture(task, parking), pictures,
                fmt::format("{}: {} states expanded", title, path.expanded),
                results.file(options.out / "tree.png"));
  if (!parking.isFound()) return;
  writeMotion({.model = task.model,
               .contacts = task.contacts,
               .body = farthestBody(task.model),
               .duration = path.length,
               .postures = [&](double rate) { return parkingMotion(parking, rate); },
               .clearance = parking.clearance.atLeast,
               .page = {.title = title,
                        .facts = {{"length", fmt::format("{:.2f} m", path.length)},
                                  {"changes of direction", fmt::format("{}", path.switches)},
                                  {"margin", fmt::format("{:g} m", *options.margin)},
                                  {"states expanded", fmt::format("{}", path.expanded)}}}},
              parkingMotion(parking, kRate), options, pictures, results);
}

Results resultsOf(const PathTask& task, const Parking& parking, const PlanOptions& options) {
  const CarPath& path = parking.path;
  const bool isFound = parking.isFound();
  const auto orNull = [&](const Json& value) { return isFound ? value : Json(); };
  Results all{.json = {{"scene", task.model.name()},
                       {"found", isFound},
                       {"message", path.driven.found.message},
                       {"expanded", path.expanded},
                       {"checks", path.driven.found.asked},
                       {"cost", orNull(path.cost)},
                       {"least_cost", orNull(path.leastCost)},
                       {"length", orNull(path.length)},
                       {"switches", orNull(path.switches)},
                       {"clearance", orNull(parking.clearance.atLeast)},
                       {"drives", Json::array()},
                       {"path", isFound ? jsonOfRows(path.driven.found.path.transpose()) : Json()}}};
  all.line("{}, hybrid A*: {}", escapeForTerminal(task.model.name()), path.driven.found.message);
  if (!isFound) return all;
  all.line("cost       {:.3f}, no path on the grid costs less than {:.3f}", path.cost, path.leastCost);
  if (std::isfinite(parking.clearance.atLeast))
    all.line("clearance  {:.4f} m all along the path, margin {:g} m", parking.clearance.atLeast,
             *options.margin);
  else
    all.line("clearance  nothing can collide");
  all.line("metres and steering angles (negative: backward)");
  for (const auto& [u, seconds] : path.driven.controls) {
    all.line("{:9.3f} {:8.3f}", u[0] * seconds, u[1]);
    all.json["drives"].push_back({u[0] * seconds, u[1]});
  }
  return all;
}

}  // namespace

ExitCode planCar(const PlanOptions& options, const RenderPlan& pictures, Model model) {
  const Car car{.wheelbase = options.wheelbase, .maxSteering = options.steering};
  const PathTask task = carTaskOf(std::move(model), options);
  makeResultFolder(options.out, {"tree.png", "path.csv", "path.mp4", "path.html"}, "path");

  const Parking parking = asWrongUse([&] { return parkCar(task, car, options.grid); });
  Results results = resultsOf(task, parking, options);
  writeFiles(task, parking, options, pictures, results);
  results.print(options.json);
  if (!parking.isFound()) return ExitCode::kBelow;
  if (parking.clearance.atLeast > (*options.margin > 0 ? 0 : -kClearanceTolerance)) return ExitCode::kFull;
  note(
      "it is not proven that shapes stay apart between the poses that were checked: use a finer --resolution "
      "or a larger --margin");
  return ExitCode::kBelow;
}

}  // namespace rex::cli

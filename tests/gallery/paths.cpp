#include "gallery/paths.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/robot/path_results.h"
#include "cli/robot/plan.h"
#include "cli/robot/posture_option.h"
#include "formats/scene_file.h"
#include "planning/robot_problem.h"
#include "render/contact_sheet.h"
#include "render/picture.h"
#include "render/renderer.h"
#include "support/paths.h"

namespace rex::gallery {
namespace {

using cli::FoundPath;
using cli::PathSearch;
using cli::PathTask;
using cli::Planner;
using Eigen::Vector3d;

Picture explored(const std::string& file, const Eigen::VectorXd& goal, double margin,
                 const PathSearch& search) {
  const Model model = compile(readScene(sourcePath("data") / file).spec);
  const ContactModel contacts(model);
  const PathTask task{model, contacts,
                      robotProblem(model, contacts, model.initialPositions(), goal, margin, 0.02)};
  const FoundPath found = cli::searchPath(task, search, 9);
  return cli::exploredPicture(task, cli::farthestBody(model), found);
}

// The box of a picture around its middle, shrunk by a factor.
Bounds zoomed(const Bounds& all, double factor) {
  const Vector3d middle = (all.low + all.high) / 2, half = (all.high - all.low) / (2 * factor);
  return {.low = middle - half, .high = middle + half};
}

bool isIn(const Bounds& box, const Vector3d& p) {
  return (p.array() >= box.low.array()).all() && (p.array() <= box.high.array()).all();
}

Image peg() {
  Eigen::VectorXd goal(7);
  goal << 0.945499, 0.431195, -1.97155, 0.623969, 2.22355, -0.665206, -1.48356;
  Picture picture = explored("robots/pegInAHole.ors", goal, 0.02, {});
  // The trees go far around the arm; edges of them that leave the picture would only look cut off.
  Bounds box = bounds({.solids = picture.solids});
  box.include(box.high + Vector3d(0, 0, 0.35)), box.low.z() += 0.3;
  for (LineSet& tree : picture.lineSets) {
    tree.color.a = 0.35f;
    std::erase_if(tree.segments,
                  [&](const auto& edge) { return !isIn(box, edge.first) || !isIn(box, edge.second); });
  }
  // The second half of the solids is the arm at its goal.
  for (std::size_t i = picture.solids.size() / 2; i < picture.solids.size(); ++i)
    picture.solids[i].color = {0.84f, 0.37f, 0.0f, 0.5f};
  picture.polylines.back().width = 8;
  return Renderer({.width = kSlideWidth, .height = kSlideHeight})
      .draw(picture, framing(box, {1, -1, 0.5}, 4. / 3));
}

Image cart() {
  const Picture picture =
      explored("scenes/maze.ors", Vector3d(3, 0, 0), 0.01, {.planner = Planner::kRrtStar, .samples = 5000});
  return Renderer({.width = kSlideWidth, .height = kSlideHeight})
      .draw(picture, framing(bounds(picture), {0, -0.7, 2}, 4. / 3));
}

// Where a motion goes: its last posture, those before it faintly, and the path of the body.
Picture followed(const Model& model, const Eigen::MatrixXd& path, const std::string& body, int faint = 5) {
  const Eigen::Index last = path.cols() - 1;
  Picture picture = scenePicture(model, forwardKinematics(model, path.col(last)));
  const std::size_t count = picture.solids.size();
  for (Eigen::Index k = 0; k < last; k += std::max<Eigen::Index>(1, last / faint)) {
    const Picture then = scenePicture(model, forwardKinematics(model, path.col(k)));
    for (std::size_t i = 0; i < count; ++i) {
      Solid solid = then.solids[i];
      if (solid.X_WS.p.isApprox(picture.solids[i].X_WS.p)) continue;
      solid.color.a = 0.25f;
      picture.solids.push_back(std::move(solid));
    }
  }
  Polyline way{.width = 8};
  const BodyId id = model.body(body);
  for (const auto& q : path.colwise()) way.points.push_back(forwardKinematics(model, q)[id].p);
  picture.polylines.push_back(std::move(way));
  return picture;
}

Image around() {
  const Model model = compile(readScene(sourcePath("data/scenes/board.ors")).spec);
  const ContactModel contacts(model);
  const Vector3d goal(0, -0.3, 0.5);
  const cli::FoundTrajectory found = cli::findTrajectory({.model = model,
                                                          .contacts = contacts,
                                                          .body = model.body("eff"),
                                                          .p_WQ = goal,
                                                          .start = model.initialPositions(),
                                                          .avoids = true});
  Picture picture = followed(model, found.path, "eff");
  // The ball of the scene is the goal of another motion.
  std::erase_if(picture.solids, [](const Solid& solid) { return solid.name == "goal"; });
  picture.pointSets.push_back({.points = {goal}, .color = {0.8f, 0.1f, 0.12f}, .size = 24});
  picture.labels.push_back({.text = "goal", .p_WQ = goal + Vector3d(0, 0.065, -0.12), .scale = 2.2});
  return Renderer({.width = kSlideWidth, .height = kSlideHeight})
      .draw(picture, framing(zoomed(bounds(picture), 1.1), {2, -0.9, 0.7}, 4. / 3));
}

Image legs() {
  SceneSpec spec = readScene(sourcePath("data/robots/humanoid/humanoid.urdf")).spec;
  for (JointSpec& joint : spec.joints) {  // the rest of the body keeps still
    const std::string& name = joint.name;
    if (name.find("hip") != name.npos || name.find("knee") != name.npos || name.find("ankle") != name.npos)
      continue;
    joint.type = JointType::kRigid;
    joint.lower = joint.upper = joint.q0 = {};
  }
  spec.postures.clear();  // they have numbers for all joints
  const Model model = compile(spec);
  const ContactModel contacts(model);
  const Eigen::VectorXd start = cli::parsePosture(model, "left_hip_roll=-.3,left_hip_pitch=-.7"),
                        goal = cli::parsePosture(model, "left_hip_roll=-.3,left_hip_pitch=.6");
  const PathTask task{model, contacts, robotProblem(model, contacts, start, goal, 0.005, 0.02)};
  Eigen::MatrixXd straight(start.size(), 41);
  for (int k = 0; k <= 40; ++k) straight.col(k) = start + k / 40. * (goal - start);
  const auto shown = [&](const Eigen::MatrixXd& path) {
    const Picture picture = followed(model, path, "left_foot", 3);
    const Bounds below{.low = {-0.45, -0.35, -0.92}, .high = {0.45, 0.45, -0.1}};
    return Renderer({.width = 625, .height = 625}).draw(picture, framing(below, {2, 0.7, 0.5}, 1));
  };
  return contactSheet({{shown(straight), "straight path, through the other leg"},
                       {shown(cli::searchPath(task, {}, 9).path), "planned path"}},
                      {.columns = 2, .pictureWidth = 625});
}

Image parking() {
  const Model model = compile(readScene(sourcePath("data/scenes/street.ors")).spec);
  const ContactModel contacts(model);
  const Vector3d goal(-1.3, 1.1, 0);
  const PathTask task =
      cli::parkingTask(model, contacts, model.initialPositions(), Eigen::VectorXd(goal), 0.05, 0.05);
  const cli::Parking found = cli::parkCar(task, {.wheelbase = 2.6, .maxSteering = 0.6}, {});
  Picture picture = cli::parkingPicture(task, found);
  const Bounds cars{.low = {-10, -0.3, 0}, .high = {8, 6, 1.5}};
  for (const Vector3d& q : {Vector3d(model.initialPositions()), goal}) {
    const Vector3d at(q.x(), q.y(), 1.8), ahead(std::cos(q.z()), std::sin(q.z()), 0);
    picture.arrows.push_back(
        {.from = at, .to = at + 2.5 * ahead, .color = {0.8f, 0.1f, 0.12f}, .radius = 0.12});
  }
  constexpr int kHigh = 560;
  return Renderer({.width = kSlideWidth, .height = kHigh})
      .draw(picture, framing(cars, {0, -0.5, 1}, static_cast<double>(kSlideWidth) / kHigh));
}

}  // namespace

std::vector<Drawing> pathPictures() {
  return {
      {"peg-path", "A peg finds its hole",
       "`rex plan pegInAHole`: one tree grows from the start, the other from the goal, with the peg in the "
       "hole (drawn faintly). Thin lines are paths of the peg; the thick line is the result, shortened and "
       "smoothed.",
       peg},
      {"maze-path", "A cart finds its way",
       "`rex plan maze --planner rrt-star`: the tree is rewired as it grows, which shortens its branches.",
       cart},
      {"around", "An arm moves around the edge of a board",
       "`rex plan board --goal eff:0,-0.3,0.5 --planner optimize --avoid`: a motion with small accelerations "
       "avoids the board and ends at rest at the goal.",
       around},
      {"legs", "One leg moves around the other",
       "`rex plan humanoid` moves the foot from one side of the stance leg to the other; the planner also "
       "avoids "
       "collisions between the legs.",
       legs},
      {"parking", "A car parks",
       "`rex plan street --goal -1.3,1.1,0 --planner hybrid-astar`: hybrid A* searches backward from the gap "
       "until a Reeds-Shepp curve reaches the start. The lines are the arcs that the search tried.",
       parking}};
}

}  // namespace rex::gallery

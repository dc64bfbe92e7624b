#include "gallery/paths.h"

#include "cli/path_pictures.h"
#include "planning/robot_problem.h"
#include "render/renderer.h"
#include "scene/scene_file.h"
#include "support/paths.h"

namespace rex::gallery {
namespace {

using cli::FoundPath;
using cli::PathSearch;
using cli::PathTask;
using cli::Planner;
using Eigen::Vector3d;

Image explored(const std::string& file, const Eigen::VectorXd& goal, double margin, const PathSearch& search,
               const Vector3d& direction) {
  constexpr int kWidth = 560, kHeight = 420;
  const Model model = compile(readScene(sourcePath("data") / file).spec);
  const ContactModel contacts(model);
  const PathTask task{model, contacts,
                      robotProblem(model, contacts, model.initialPositions(), goal, margin, 0.02)};
  const FoundPath found = cli::searchPath(task, search, 9);
  const Picture picture = cli::exploredPicture(task, cli::farthestBody(model), found);
  return Renderer({.width = kWidth, .height = kHeight})
      .draw(picture, framing(bounds(picture), direction, static_cast<double>(kWidth) / kHeight));
}

Image peg() {
  Eigen::VectorXd goal(7);
  goal << 0.945499, 0.431195, -1.97155, 0.623969, 2.22355, -0.665206, -1.48356;
  return explored("robots/pegInAHole.ors", goal, 0.02, {}, {1, -1, 0.5});
}

Image cart() {
  return explored("scenes/maze.ors", Vector3d(3, 0, 0), 0.01, {.planner = Planner::kRrtStar, .samples = 5000},
                  {0, -0.7, 2});
}

}  // namespace

std::vector<Drawing> pathPictures() {
  return {
      {"peg-path", "A peg finds its hole",
       "`rex plan pegInAHole`: two trees grow, one from the posture that is drawn, one from the goal in the "
       "hole, which is drawn faintly. Lines are the ways of the peg's middle, the thick one is the path, "
       "shortened and rounded.",
       peg},
      {"maze-path", "A cart finds its way",
       "`rex plan maze --planner rrt-star`: a tree that rewires itself, so that its branches become short.",
       cart}};
}

}  // namespace rex::gallery

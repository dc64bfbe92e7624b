// Chapter 4: A car parks. It cannot slide sideways, so a tree of drives grows out of the gap until it meets
// the waiting car, which then drives the way back in: drives can be reversed. Hybrid A* searches on a grid
// of states for a way that is short and changes its direction seldom. Sliders change gap and steering.
// Slides: 4:54 to 4:56
// Formula: x' = v cos θ, y' = v sin θ, θ' = v tan φ / L, |φ| <= Φ
// Try: A tree of drives finds a path out of a gap; "tree or hybrid A*" compares it with a search on a grid.
// Reduce the "gap" and the "largest steering".
#include "course/car_pictures.h"
#include "course/course.h"
#include "course/live_view.h"
#include "planning/car_curves.h"
#include "planning/hybrid_astar.h"
#include "render/picture.h"
#include "systems/car.h"

using namespace rex;

// The poses along a way, 1/15 s apart, and what there is to say about it.
std::pair<std::vector<Eigen::Vector3d>, std::string> drivenAlong(const Car& car, const ControlPath& way) {
  std::vector<Eigen::Vector3d> poses;
  double metres = 0, last = 0;
  int turns = 0;
  for (std::size_t k = 0; k < way.controls.size(); ++k) {
    const auto& [u, seconds] = way.controls[k];
    const Eigen::Vector3d from = way.found.path.col(static_cast<Eigen::Index>(k));
    for (double s = 0; s < seconds; s += 1 / 15.) poses.push_back(driveCar(car, from, u, s));
    metres += std::abs(u[0]) * seconds;
    turns += std::exchange(last, u[0]) * u[0] < 0;
  }
  if (poses.empty()) return {poses, "nothing found"};
  return {poses, std::to_string(metres).substr(0, 4) + " m, changes of direction: " + std::to_string(turns)};
}

int main() {
  LiveView view("parking");
  view.lookFrom({0, -0.7, 1});
  Eigen::Vector3d last(0, 0, 0);
  ControlPath way;
  int age = 0, seed = 1;
  bool onGrid = false;
  for (int t = 0; t < 600 || view.isWatched(); ++t, ++age) {
    const double gap = view.slider("gap [m]", 3.6, 9, 5),
                 steering = view.slider("largest steering [rad]", 0.3, 1, 0.7);
    if (view.button("another tree")) ++seed, onGrid = false, last.setZero();
    if (view.button("tree or hybrid A*") || (!view.isWatched() && t == 360)) onGrid = !onGrid, last.setZero();
    if (const Eigen::Vector3d now(gap, steering, 0); now != last) last = now, age = 0;
    const Car car{.wheelbase = 2, .maxSteering = steering};
    // Cars are 3 m long and 1.5 m wide; their poses are 0.5 m ahead of the rear end.
    const auto isFree = [&](const VectorArg& x) {
      for (const double ahead : {-0.5, 0., 0.5, 1., 1.5, 2., 2.5})
        for (const double aside : {-0.75, 0., 0.75}) {
          const double px = x[0] + ahead * std::cos(x[2]) - aside * std::sin(x[2]),
                       py = x[1] + ahead * std::sin(x[2]) + aside * std::cos(x[2]);
          if (py < 0 || py > 6.5 || (py < 1.8 && std::abs(px) > gap / 2)) return false;
        }
      return true;
    };
    const double radius = car.turningRadius();
    const ControlSystem system{
        .space = Space::se2({-9, 0.5}, {8, 6}),
        .lower = Eigen::Vector2d(-1, -steering),
        .upper = Eigen::Vector2d(1, steering),
        .motion = [&](const VectorArg& x, const VectorArg& u,
                      double s) { return Eigen::VectorXd(driveCar(car, x, u, s)); },
        .distance = [&](const VectorArg& a, const VectorArg& b) { return reedsSheppLength(a, b, radius); }};
    const PathProblem problem{.space = system.space,
                              .allValid = eachColumn(isFree),
                              .start = Eigen::Vector3d(-1, 0.95, 0),
                              .goal = Eigen::Vector3d(-6.5, 4, 0),
                              .resolution = 0.05};
    if (age == 0 && onGrid) {
      const HybridAStarOptions grid{.cellSize = 0.2, .headings = 72, .reverseFactor = 1, .fromGoal = false};
      way = findCarPath(car, problem, grid).driven;
    } else if (age == 0) {
      Rng rng(seed);
      way = growControlTree(system, problem,
                            {.shortest = 0.4,
                             .longest = 0.8,
                             .trials = 8,
                             .goalBias = 0.2,
                             .tolerance = 0.6,
                             .maxSamples = 1500},
                            rng);
    }
    const int nodes = static_cast<int>(way.found.trees.at(0).nodes.cols()), grown = onGrid ? 60 : 120,
              shown = std::min(nodes, 1 + nodes * age / grown);  // for two or four seconds
    const auto [poses, text] = drivenAlong(car, way);
    CarView show{.car = problem.goal, .estimate = problem.start};
    if (const int last = static_cast<int>(poses.size()) - 1; last >= 0 && shown == nodes)
      show.car = poses[std::max(0, last - std::max(0, age - grown) % (last + 30))];  // driven backward
    show.caption = std::string(onGrid ? "hybrid A*: " : "tree: ") + std::to_string(shown) + " states";
    if (shown == nodes) show.caption += "; " + text;
    Picture picture = carPicture(show);
    LineSet tree{.color = kEstimateColor, .width = 1.5};
    const PathTree& one = way.found.trees[0];
    for (int i = 0; i < shown; ++i)
      if (const int p = one.parents[i]; p >= 0)
        tree.segments.push_back(
            {{one.nodes(0, i), one.nodes(1, i), 0.03}, {one.nodes(0, p), one.nodes(1, p), 0.03}});
    if (!tree.segments.empty()) picture.lineSets.push_back(tree);
    Polyline found;
    for (const Eigen::Vector3d& x : poses) found.points.emplace_back(x[0], x[1], 0.05);
    if (shown == nodes && poses.size() > 1) picture.polylines.push_back(found);
    for (const double side : {-1., 1.})
      picture.solids.push_back({{.type = ShapeType::kBox, .extent = {3, 1.5, 1}},
                                translation(side * (gap / 2 + 1.5), 1, 0.5),
                                kTruthColor,
                                "parked"});
    const Shape kerb{.type = ShapeType::kBox, .extent = {20, 0.3, 0.2}};
    picture.solids.push_back({kerb, translation(0, -0.15, 0.1), kScanColor, "kerb"});
    view.plot("states", t / 30., static_cast<double>(tree.segments.size()));
    view.show(picture);
  }
}

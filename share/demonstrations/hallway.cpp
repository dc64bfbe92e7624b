// Chapter 7: A corridor with doors. A robot walks up and down and sees doors, with errors; bars show how
// probable it thinks each cell is. Doors that look alike leave several peaks, a move widens them, a door that
// fits removes the others. Sliders set the errors; a button carries the robot to another cell.
// Slides: 7:13 to 7:15
// Formula: bel(x) ~ P(y|x) Σ_x' P(x|u, x') bel(x')
// Try: A robot walks up and down a corridor and sees doors; bars are its belief. Press "carry it away": it
// recovers within a few doors. Set "misses" and "alarms" to 0.5: it only spreads. Set "slips and leaps" to
// 0 and carry it away: it stays lost for long.
#include <algorithm>
#include <vector>

#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "estimation/histogram_filter.h"
#include "render/picture.h"

using namespace rex;

int main() {
  LiveView view("hallway");
  view.lookFrom({0.05, -1, 0.45});
  constexpr int kCells = 20;
  Eigen::VectorXd doors = Eigen::VectorXd::Zero(kCells),
                  belief = Eigen::VectorXd::Constant(kCells, 1. / kCells);
  for (const int door : {2, 5, 6, 13}) doors[door] = 1;
  Rng rng(2);
  int cell = 2, way = 1;
  bool sees = false;
  const auto inside = [](int i) { return std::clamp(i, 0, kCells - 1); };
  for (int t = 0; t < 600 || view.isWatched(); ++t) {
    const double misses = view.slider("misses", 0, 0.5, 0.2), alarms = view.slider("alarms", 0, 0.5, 0.1),
                 errors = view.slider("slips and leaps", 0, 0.3, 0.1);
    const int frames = static_cast<int>(view.slider("pictures for each step", 1, 30, 10));
    if (view.button("carry it away")) cell = rng.index(kCells);
    if (view.button("know nothing")) belief.setConstant(1. / kCells);
    if (t % frames == 0) {
      // A move: every cell passes its probability on.
      if (cell == 0) way = 1;
      if (cell == kCells - 1) way = -1;
      std::vector<Eigen::Triplet<double>> entries;
      const double chances[] = {errors, 1 - 2 * errors, errors};
      for (int j = 0; j < kCells; ++j)
        for (int k = 0; k < 3; ++k) entries.emplace_back(inside(j + way * k), j, chances[k]);
      CellTransition transition(kCells, kCells);
      transition.setFromTriplets(entries.begin(), entries.end());
      const double chance = rng.uniform();
      cell = inside(cell + way * (chance < errors ? 0 : chance < 1 - errors ? 1 : 2));
      // A look.
      sees = rng.uniform() < (doors[cell] > 0 ? 1 - misses : alarms);
      Eigen::VectorXd likelihood(kCells);
      for (int i = 0; i < kCells; ++i) {
        const double door = doors[i] > 0 ? 1 - misses : alarms;
        likelihood[i] = sees ? door : 1 - door;
      }
      belief = updateCells(predictCells(belief, transition), likelihood).belief;
      view.plot("belief in the true cell", t / 30., belief[cell]);
    }

    Picture picture{.ground = {.visible = false}};
    for (int i = 0; i < kCells; ++i) {
      const double height = 0.02 + 6 * belief[i];
      picture.solids.push_back(
          {{.extent = {0.8, 0.5, height}}, translation(i, 0, height / 2), kEstimateColor, "belief"});
      picture.solids.push_back({{.extent = {0.98, 0.1, doors[i] > 0 ? 1.6 : 1.8}},
                                translation(i, 1.5, doors[i] > 0 ? 0.8 : 0.9),
                                doors[i] > 0 ? kLandmarkColor : Color{0.75f, 0.75f, 0.75f},
                                doors[i] > 0 ? "door" : "wall"});
    }
    picture.solids.push_back(
        {{.extent = {0.6, 0.5, 0.6}}, translation(cell, 0.8, 0.3), kTruthColor, "robot"});
    picture.captions.push_back(
        {.text = sees ? "the robot sees a door" : "the robot sees no door", .scale = 1.5});
    view.show(picture);
  }
}

#include "grading/check.h"

#include "interface.h"
#include "particle_checks.h"
#include "tour_checks.h"

using rex::grading::Group;

namespace {

void followsRays(Check& check, Student& student) {
  Grid grid = randomGrid(10, 8, check.rng());
  findsCells(check, student, grid, 1);
  const Eigen::Vector2d p = grid.origin + grid.cell * Eigen::Vector2d(2.3, 1.6);
  followsSegment(check, student, grid, p, p + grid.cell * Eigen::Vector2d(5.1, 3.3));
  followsSegment(check, student, grid, p + grid.cell * Eigen::Vector2d(1.1, 5), p);
  followsSegment(check, student, grid, p, p + grid.cell * Eigen::Vector2d(4, 0));
  followsSegment(check, student, grid, p, p + grid.cell * Eigen::Vector2d(.1, .2));
}

void updatesMap(Check& check, Student& student) {
  // Many rays, so that some pass through cells in which others end.
  check.forEachCase(5, [&](int i) { updates(check, student, i < 4 ? 3 + 2 * i : 60, {.bound = 4.5}); });
}

void measuresWalls(Check& check, Student& student) {
  check.forEachCase(3, [&](int i) { measuresDistances(check, student, 6 + 2 * i, 9 - i); });
}

void ratesScans(Check& check, Student& student) {
  interpolates(check, student, randomGrid(5, 4, check.rng()));
  rates(check, student, 4);
  rates(check, student, 9);
}

// The last one fits best outside of the window.
void matchesScans(Check& check, Student& student) {
  check.forEachCase(5, [&](int i) { matches(check, student, i < 4 ? .8 : 2.2); });
}

// Among particles of almost equal weights, a likely one is lost easily.
void resamplesParticles(Check& check, Student& student) {
  for (const double spread : {1.5, .2}) resamples(check, student, 8, spread);
}

void mapsOnce(Check& check, Student& student) { maps(check, student); }

void locatesOnce(Check& check, Student& student) {
  check.forEachCase(2, [&](int) { locates(check, student); });
}

// <hidden>
void followsMore(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    const Grid grid = randomGrid(12, 9, check.rng());
    findsCells(check, student, grid, 3);
    const Eigen::Vector2d from = pointIn(grid, check.rng());
    const auto another = [&] {
      Eigen::Vector2d point = pointIn(grid, check.rng());
      while (point == from) point = pointIn(grid, check.rng());
      return point;
    };
    followsSegment(check, student, grid, from, another());
    followsSegment(check, student, grid, from, from - grid.cell * Eigen::Vector2d(0, 15));
    followsSegment(check, student, grid, from, 3 * (another() - from) + from);
  });
}

void updatesMore(Check& check, Student& student) {
  check.forEachCase(
      8, [&](int i) { updates(check, student, 10 + 3 * i, {.hit = 2.1, .miss = -.7, .bound = 4}); });
}

void ratesMore(Check& check, Student& student) {
  check.forEachCase(8, [&](int i) {
    measuresDistances(check, student, 10 + 3 * i, 24 - i);
    interpolates(check, student, randomGrid(2 + i, 9 - i, check.rng()));
    rates(check, student, 8 + 5 * i);
  });
}

void matchesMore(Check& check, Student& student) {
  check.forEachCase(10, [&](int i) { matches(check, student, i % 5 == 4 ? 1.3 : .1 + .2 * (i % 5)); });
}

void resamplesMore(Check& check, Student& student) {
  check.forEachCase(3, [&](int i) { resamples(check, student, 5 + 7 * i, .5 + i); });
}

void mapsMore(Check& check, Student& student) {
  check.forEachCase(2, [&](int) { maps(check, student); });
}

void locatesMore(Check& check, Student& student) {
  check.forEachCase(4, [&](int) { locates(check, student); });
}
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"rays", "grid", "Cells of a ray", 1, Group::kVisible, followsRays},
      {"update", "grid", "A scan in a map", 1, Group::kVisible, updatesMap},
      {"distances", "fit", "Distances from walls", 1, Group::kVisible, measuresWalls},
      {"fits", "fit", "How well scans fit", 1, Group::kVisible, ratesScans},
      {"match", "match", "Matches of scans", 1, Group::kVisible, matchesScans},
      {"motion", "particles", "Motions with noise", 1, Group::kVisible, movesOnce},
      {"weights", "particles", "Weights and their effective size", 1, Group::kVisible, weighsParticles},
      {"copies", "particles", "Resampling", 1, Group::kVisible, resamplesParticles},
      {"step", "particles", "A step of three particles", 1, Group::kVisible, stepsParticles},
      {"tour", "particles", "The map of a tour", 1, Group::kVisible, mapsOnce},
      {"rule", "particles", "When to resample", 1, Group::kVisible, keepsRule},
      {"wake-up", "anywhere", "Two robots that wake up", 1, Group::kVisible, locatesOnce},
      // <hidden>
      {"more-rays", "grid", "Cells of other rays", 1, Group::kHidden, followsMore},
      {"more-updates", "grid", "Scans in other maps", 1, Group::kHidden, updatesMore},
      {"more-fits", "fit", "Distances and scans in other maps", 1, Group::kHidden, ratesMore},
      {"more-matches", "match", "Scans in other buildings", 2, Group::kHidden, matchesMore},
      {"more-copies", "particles", "Resampling of other particles", 1, Group::kHidden, resamplesMore},
      {"more-tours", "particles", "Maps of other buildings", 1, Group::kHidden, mapsMore},
      {"more-wake-ups", "anywhere", "Robots elsewhere", 1, Group::kHidden, locatesMore},
      // </hidden>
  };
}

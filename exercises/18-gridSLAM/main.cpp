#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "exercise.h"
#include "show.h"

using namespace rex;

Eigen::Vector2i cellAt(const Grid& grid, const Eigen::Vector2d& p) {
  // TODO: how many cells from the origin, rounded down?
  return Eigen::Vector2i::Zero();
}

std::vector<Eigen::Vector2i> cellsAlong(const Grid& grid, const Eigen::Vector2d& from,
                                        const Eigen::Vector2d& to) {
  // TODO: step from grid line to grid line. Is the next crossing along x or along y?
  return {};
}

Grid observed(const Grid& map, const Eigen::Vector3d& pose, const Scan& scan, const CellEvidence& evidence) {
  Grid after = map;
  // TODO: follow each ray, and note for each cell whether a ray ends in it, or only passes.
  return after;
}

Grid wallDistances(const Grid& map, double reach) {
  Grid distances = map;
  distances.values.setConstant(reach);
  // TODO: which cells are nearer to an occupied cell than `reach`?
  return distances;
}

double valueAt(const Grid& grid, const Eigen::Vector2d& p) {
  // TODO: the centre of cell (0, 0) is half a cell from the origin. Which four centres are around p?
  return 0;
}

double fit(const Grid& distances, const Eigen::Vector3d& pose, const Scan& scan, double deviation) {
  // TODO: where do the rays end, seen from this pose, and how far from a wall is that?
  return 0;
}

Eigen::Vector3d matched(const Grid& distances, const Scan& scan, double deviation,
                        const Eigen::Vector3d& guess, const Eigen::Vector2d& window) {
  // TODO: try poses around the guess, and around the best one so far in smaller and smaller steps.
  return guess;
}

Eigen::Matrix3Xd moved(const Eigen::Vector3d& pose, const Eigen::Vector3d& motion,
                       const Eigen::Vector3d& deviations, int count, Rng& rng) {
  Eigen::Matrix3Xd poses = pose.replicate(1, count);
  // TODO: add noise to the motion, and turn it into the world frame.
  return poses;
}

Eigen::VectorXd weightsOf(const std::vector<Particle>& particles) {
  Eigen::VectorXd weights(static_cast<Eigen::Index>(particles.size()));
  // TODO: exp(), in a way that never divides zero by zero.
  weights.setZero();
  return weights;
}

double effectiveSize(const Eigen::VectorXd& weights) {
  // TODO
  return 0;
}

std::vector<Particle> resampled(const std::vector<Particle>& particles, Rng& rng) {
  std::vector<Particle> copies;
  // TODO: how often each particle occurs: one random number is enough for all.
  copies = particles;
  return copies;
}

std::vector<Particle> slamStep(const std::vector<Particle>& particles, const Eigen::Vector3d& motion,
                               const Scan& scan, const Settings& settings, Rng& rng) {
  std::vector<Particle> after = particles;
  // TODO: for each particle: a pose, what the scan says about it, and the map.
  return after;
}

Mapped mapped(const Log& log, const Grid& empty, const Settings& settings, int count, Rng& rng) {
  std::vector<Particle> particles(static_cast<std::size_t>(count), Particle{{log.start}, empty, 0});
  std::vector<double> sizes;
  // TODO: the first scan, then step after step, with particles resampled where they are too unequal.
  const auto best =
      std::max_element(particles.begin(), particles.end(),
                       [](const Particle& a, const Particle& b) { return a.logWeight < b.logWeight; });
  return {best->path, best->map, sizes};
}

Eigen::Vector3d located(const Grid& map, const Scan& scan, const Settings& settings) {
  // TODO: which free cell, with which heading, fits best? Then match.
  return Eigen::Vector3d::Zero();
}

// What follows is given, and never graded: change it as you like. show.h says what each line draws.

int main() {
  const Office office = officeOfShow();
  // Part 1: one scan, and the map if all poses were known.
  showScan(office);
  // Part 2: how far walls are, and how well a scan fits around its true pose.
  showFit(office);
  // Part 3: from which guesses the match converges to the true pose.
  showMatches(office);
  // Part 4: maps by odometry, by particles, and the truth; a film of how one grows.
  showMaps(office);
  // Part 5: a robot that wakes up anywhere.
  showAnywhere(office);
}

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exercise.h"
#include "show.h"

using namespace rex;

Eigen::VectorXd doorChances(bool door, const Corridor& corridor) {
  Eigen::VectorXd chances = Eigen::VectorXd::Ones(corridor.doors.size());
  // TODO: how likely is a door, or none, at a door and at the wall?
  return chances;
}

Eigen::VectorXd movedCells(const Eigen::VectorXd& belief, int way, const Corridor& corridor) {
  Eigen::VectorXd after = Eigen::VectorXd::Zero(belief.size());
  // TODO: where may the robot be after the move, for each cell where it may have been?
  return after;
}

Eigen::VectorXd seenCells(const Eigen::VectorXd& belief, bool door, const Corridor& corridor) {
  Eigen::VectorXd after = belief;
  // TODO: Bayes' rule, cell by cell.
  return after;
}

std::vector<Eigen::VectorXd> cellsInHindsight(const Eigen::VectorXd& prior, const std::vector<int>& ways,
                                              const std::vector<int>& seen, const Corridor& corridor) {
  std::vector<Eigen::VectorXd> beliefs(seen.size(), prior);
  // TODO: the filter forwards, and what was seen later backwards.
  return beliefs;
}

Eigen::Vector3d carStep(const Eigen::Vector3d& x, const Eigen::Vector2d& u, const CarWorld& world) {
  // TODO: slide 4:48, with a dot over the theta of its third line.
  return x;
}

Eigen::MatrixXd moved(const Eigen::MatrixXd& states, const Eigen::Vector2d& u, const CarWorld& world,
                      Rng& rng) {
  Eigen::MatrixXd next = states;
  // TODO: each column one step on. rng.normal() is one number of standard deviation 1, and
  // rng.normalVector(3) are three.
  return next;
}

Eigen::VectorXd viewFrom(const Eigen::Vector3d& x, const CarWorld& world) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(2 * world.landmarks.cols());
  // TODO: the landmarks in the frame of the car. Part 7: their distances and bearings, too.
  return y;
}

Eigen::VectorXd logLikelihoods(const Eigen::MatrixXd& states, const Eigen::VectorXd& y,
                               const CarWorld& world) {
  Eigen::VectorXd logarithms = Eigen::VectorXd::Zero(states.cols());
  // TODO: the logarithm of a normal density, for each particle over all that was seen. How often is a
  // noise of 0.5 off by 1?
  return logarithms;
}

Eigen::VectorXd weightsOf(const Eigen::VectorXd& logarithms) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(logarithms.size());
  // TODO: what is exp(-10000), and what is 0 / 0? Which factor may all weights have?
  return weights;
}

std::vector<int> resampledParents(const Eigen::VectorXd& weights, int count, Rng& rng) {
  std::vector<int> parents;
  // TODO: slide 7:23: whole parts for certain, the rest by chance. rng.uniform() is in [0, 1).
  parents.assign(static_cast<std::size_t>(count), 0);
  return parents;
}

double effectiveSize(const Eigen::VectorXd& weights) {
  // TODO: 1 for one particle that has it all, N for N that share it.
  return static_cast<double>(weights.size());
}

Cloud filterStep(const Cloud& before, const Eigen::Vector2d& u, const Eigen::VectorXd& y,
                 const CarWorld& world, Rng& rng) {
  Cloud after = before;
  // TODO: resample, move, weigh. You have functions for all three.
  return after;
}

Eigen::Vector3d meanPose(const Cloud& cloud) {
  // TODO: which direction lies between the headings 3.1 and -3.1?
  return Eigen::Vector3d::Zero();
}

double likelyNoise(const DriveLog& log, const CarWorld& world, Rng& rng) {
  // TODO: how large is what the car saw, without what your filter explains of it?
  return world.observationNoise;
}

// What follows is given: the parts of the exercise one after another. show.cpp draws the pictures.
int main() {
  // Part 1: a robot walks along a corridor with four doors, and does not know where it begins.
  const Corridor corridor = corridorOfFourDoors();
  const Walk walk = recordWalk(corridor);
  std::vector<Eigen::VectorXd> beliefs;
  Eigen::VectorXd belief = Eigen::VectorXd::Constant(corridor.doors.size(), 1. / corridor.doors.size());
  const Eigen::VectorXd prior = belief;
  for (std::size_t t = 0; t < walk.seen.size(); ++t) {
    if (t > 0) belief = movedCells(belief, walk.ways[t - 1], corridor);
    belief = seenCells(belief, walk.seen[t] == 1, corridor);
    beliefs.push_back(belief);
  }
  showCorridor(beliefs, cellsInHindsight(prior, walk.ways, walk.seen, corridor), walk, corridor);

  // The car drives in circles, past two landmarks, and 100 particles start where it does.
  CarWorld world;
  world.landmarks = (Eigen::MatrixXd(2, 2) << 15, -6, 5, 12).finished();
  const RecordedDrive drive = recordDrive(world, {0.1, 0.2});
  const Cloud start{Eigen::MatrixXd::Zero(3, 100), Eigen::VectorXd::Constant(100, 0.01)};

  // Part 2: they move as the car is commanded to, and do not look.
  Rng rng(5);
  std::vector<Cloud> blind;
  Cloud cloud = start;
  for (const Eigen::Vector2d& u : drive.log.controls) {
    cloud.states = moved(cloud.states, u, world, rng);
    blind.push_back(cloud);
  }
  showDeadReckoning(blind, drive, world);

  // Part 3: what the car sees in step 150, and two particles that explain nothing.
  showLikelihood(150, drive, world);
  print("weights of exp(-20000) and exp(-20001), with the sum 1", weightsOf(Eigen::Vector2d(-20000, -20001)));

  // Part 4: ten children of three parents.
  showChildren(Eigen::Vector3d(0.55, 0.25, 0.2), 10);

  // Part 5: the particles look, with the noise of the sensor and with wrong ones.
  rng = Rng(5);
  std::vector<Cloud> clouds;
  cloud = start;
  for (std::size_t t = 0; t < drive.log.controls.size(); ++t) {
    cloud = filterStep(cloud, drive.log.controls[t], drive.log.observations[t], world, rng);
    clouds.push_back(cloud);
  }
  showFilter(clouds, blind, drive, world);
  showAssumptions(drive, world);

  // Part 6: past eight landmarks, with a noise of 0.5 m.
  CarWorld many = world;
  many.landmarks =
      (Eigen::MatrixXd(2, 8) << 15, -6, 20, 3, -12, 8, 0, 12, 5, 12, 22, -8, 1, 28, 20, -2).finished();
  const DriveLog log = recordDrive(many, {0.1, 0.2}).log;
  for (const double assumed : {5., 0.5, 0.05}) {
    many.observationNoise = assumed;
    print("assumed noise [m]", assumed);
    print("noise found, which should be near 0.5 [m]", likelyNoise(log, many, rng));
  }

  // Part 7: distances and bearings.
  CarWorld polar = world;
  polar.rangeBearing = true;
  polar.bearingNoise = 0.1;
  polar.landmarks = (Eigen::MatrixXd(2, 3) << 15, -6, 2, 5, 8, -7).finished();
  showBearings(recordDrive(polar, {0.3, 0.2}), polar);
}

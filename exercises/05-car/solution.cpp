#include <algorithm>
#include <cmath>
#include <numbers>

#include "exercise.h"
#include "show.h"
// <solution headers>
// What a mistake in wrong.cpp takes from the library.
// <todo>
// </solution>

using namespace rex;

Eigen::VectorXd doorChances(bool door, const Corridor& corridor) {
  Eigen::VectorXd chances = Eigen::VectorXd::Ones(corridor.doors.size());
  // <solution doorChances>
  for (Eigen::Index i = 0; i < chances.size(); ++i) {
    const double seesDoor = corridor.doors[i] > 0.5 ? 1 - corridor.misses : corridor.alarms;
    chances[i] = door ? seesDoor : 1 - seesDoor;
  }
  // <todo>
  //| // TODO: how likely is a door, or none, at a door and at the wall?
  // </solution>
  return chances;
}

Eigen::VectorXd movedCells(const Eigen::VectorXd& belief, int way, const Corridor& corridor) {
  Eigen::VectorXd after = Eigen::VectorXd::Zero(belief.size());
  // <solution movedCells>
  const double chances[] = {corridor.slips, 1 - corridor.slips - corridor.leaps, corridor.leaps};
  for (Eigen::Index i = 0; i < belief.size(); ++i)
    for (int cells = 0; cells < 3; ++cells)
      after[std::clamp<Eigen::Index>(i + way * cells, 0, belief.size() - 1)] += chances[cells] * belief[i];
  // <todo>
  //| // TODO: where may the robot be after the move, for each cell where it may have been?
  // </solution>
  return after;
}

Eigen::VectorXd seenCells(const Eigen::VectorXd& belief, bool door, const Corridor& corridor) {
  Eigen::VectorXd after = belief;
  // <solution seenCells>
  after = belief.cwiseProduct(doorChances(door, corridor));
  const double evidence = after.sum();
  if (!(evidence > 0)) return belief;
  after /= evidence;
  // <todo>
  //| // TODO: Bayes' rule, cell by cell.
  // </solution>
  return after;
}

std::vector<Eigen::VectorXd> cellsInHindsight(const Eigen::VectorXd& prior, const std::vector<int>& ways,
                                              const std::vector<int>& seen, const Corridor& corridor) {
  std::vector<Eigen::VectorXd> beliefs(seen.size(), prior);
  // <solution cellsInHindsight>
  for (std::size_t t = 0; t < seen.size(); ++t)
    beliefs[t] =
        seenCells(t == 0 ? prior : movedCells(beliefs[t - 1], ways[t - 1], corridor), seen[t] == 1, corridor);
  // What was seen later, from each cell: up to a factor, which cancels.
  Eigen::VectorXd later = Eigen::VectorXd::Ones(prior.size());
  for (std::size_t t = ways.size(); t-- > 0;) {
    const Eigen::VectorXd ahead = later.cwiseProduct(doorChances(seen[t + 1] == 1, corridor));
    for (Eigen::Index i = 0; i < later.size(); ++i)
      later[i] = movedCells(Eigen::VectorXd::Unit(prior.size(), i), ways[t], corridor).dot(ahead);
    later /= later.sum();
    beliefs[t] = beliefs[t].cwiseProduct(later);
    beliefs[t] /= beliefs[t].sum();
  }
  // <todo>
  //| // TODO: the filter forwards, and what was seen later backwards.
  // </solution>
  return beliefs;
}

Eigen::Vector3d carStep(const Eigen::Vector3d& x, const Eigen::Vector2d& u, const CarWorld& world) {
  // <solution carStep>
  const double way = world.tau * u[0];
  return {x[0] + way * std::cos(x[2]), x[1] + way * std::sin(x[2]),
          x[2] + way / world.wheelbase * std::tan(u[1])};
  // <todo>
  //| // TODO: slide 4:48, with a dot over the theta of its third line.
  //| return x;
  // </solution>
}

Eigen::MatrixXd moved(const Eigen::MatrixXd& states, const Eigen::Vector2d& u, const CarWorld& world,
                      Rng& rng) {
  Eigen::MatrixXd next = states;
  // <solution moved>
  for (Eigen::Index i = 0; i < states.cols(); ++i)
    next.col(i) = carStep(states.col(i), u, world) + world.dynamicsNoise * rng.normalVector(3);
  // <todo>
  //| // TODO: each column one step on. rng.normal() is one number of standard deviation 1, and
  //| // rng.normalVector(3) are three.
  // </solution>
  return next;
}

Eigen::VectorXd viewFrom(const Eigen::Vector3d& x, const CarWorld& world) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(2 * world.landmarks.cols());
  // <solution viewFrom>
  const double c = std::cos(x[2]), s = std::sin(x[2]);
  for (Eigen::Index i = 0; i < world.landmarks.cols(); ++i) {
    const double dx = world.landmarks(0, i) - x[0], dy = world.landmarks(1, i) - x[1];
    const double ahead = c * dx + s * dy, left = c * dy - s * dx;
    y[2 * i] = world.rangeBearing ? std::hypot(ahead, left) : ahead;
    y[2 * i + 1] = world.rangeBearing ? std::atan2(left, ahead) : left;
  }
  // <todo>
  //| // TODO: the landmarks in the frame of the car. Part 7: their distances and bearings, too.
  // </solution>
  return y;
}

Eigen::VectorXd logLikelihoods(const Eigen::MatrixXd& states, const Eigen::VectorXd& y,
                               const CarWorld& world) {
  Eigen::VectorXd logarithms = Eigen::VectorXd::Zero(states.cols());
  // <solution logLikelihoods>
  for (Eigen::Index i = 0; i < states.cols(); ++i) {
    const Eigen::VectorXd seen = viewFrom(states.col(i), world);
    for (Eigen::Index k = 0; k < y.size(); ++k) {
      const bool isBearing = world.rangeBearing && k % 2 == 1;
      const double error = isBearing ? std::remainder(y[k] - seen[k], 2 * std::numbers::pi) : y[k] - seen[k];
      const double deviations = error / (isBearing ? world.bearingNoise : world.observationNoise);
      logarithms[i] -= deviations * deviations / 2;
    }
  }
  // <todo>
  //| // TODO: the logarithm of a normal density, for each particle over all that was seen. How often is a
  //| // noise of 0.5 off by 1?
  // </solution>
  return logarithms;
}

Eigen::VectorXd weightsOf(const Eigen::VectorXd& logarithms) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(logarithms.size());
  // <solution weightsOf>
  // A common factor cancels. With this one the largest weight is exp(0): the sum is at least 1.
  const double largest = logarithms.maxCoeff();
  for (Eigen::Index i = 0; i < weights.size(); ++i)
    weights[i] = std::isfinite(largest) ? std::exp(logarithms[i] - largest) : 1;
  weights /= weights.sum();
  // <todo>
  //| // TODO: what is exp(-10000), and what is 0 / 0? Which factor may all weights have?
  // </solution>
  return weights;
}

std::vector<int> resampledParents(const Eigen::VectorXd& weights, int count, Rng& rng) {
  std::vector<int> parents;
  // <solution resampledParents>
  // The integer parts are certain. For what remains, `count` - `parents` places stand on the line of the
  // fractions, one apart, and all are shifted by the same random number.
  Eigen::VectorXd rest = count * weights;
  for (int i = 0; i < rest.size(); ++i) {
    const int whole = static_cast<int>(rest[i] + 1e-9);
    parents.insert(parents.end(), static_cast<std::size_t>(whole), i);
    rest[i] = std::max(0., rest[i] - whole);
  }
  double place = rng.uniform(), end = 0;
  for (int i = 0; i < rest.size(); ++i)
    for (end += rest[i]; place < end && static_cast<int>(parents.size()) < count; place += 1)
      parents.push_back(i);
  // A place may fall off the end of the line by rounding.
  int heaviest = 0;
  weights.maxCoeff(&heaviest);
  parents.resize(static_cast<std::size_t>(count), heaviest);
  // <todo>
  //| // TODO: slide 7:23: whole parts for certain, the rest by chance. rng.uniform() is in [0, 1).
  //| parents.assign(static_cast<std::size_t>(count), 0);
  // </solution>
  return parents;
}

double effectiveSize(const Eigen::VectorXd& weights) {
  // <solution effectiveSize>
  return 1 / weights.squaredNorm();
  // <todo>
  //| // TODO: 1 for one particle that has it all, N for N that share it.
  //| return static_cast<double>(weights.size());
  // </solution>
}

Cloud filterStep(const Cloud& before, const Eigen::Vector2d& u, const Eigen::VectorXd& y,
                 const CarWorld& world, Rng& rng) {
  Cloud after = before;
  // <solution filterStep>
  const std::vector<int> parents =
      resampledParents(before.weights, static_cast<int>(before.weights.size()), rng);
  for (std::size_t i = 0; i < parents.size(); ++i)
    after.states.col(static_cast<Eigen::Index>(i)) = before.states.col(parents[i]);
  after.states = moved(after.states, u, world, rng);
  after.weights = weightsOf(logLikelihoods(after.states, y, world));
  // <todo>
  //| // TODO: resample, move, weigh. You have functions for all three.
  // </solution>
  return after;
}

Eigen::Vector3d meanPose(const Cloud& cloud) {
  // <solution meanPose>
  double c = 0, s = 0;
  for (Eigen::Index i = 0; i < cloud.weights.size(); ++i) {
    c += cloud.weights[i] * std::cos(cloud.states(2, i));
    s += cloud.weights[i] * std::sin(cloud.states(2, i));
  }
  Eigen::Vector3d mean = cloud.states * cloud.weights;
  mean[2] = std::atan2(s, c);
  return mean;
  // <todo>
  //| // TODO: which direction lies between the headings 3.1 and -3.1?
  //| return Eigen::Vector3d::Zero();
  // </solution>
}

double likelyNoise(const DriveLog& log, const CarWorld& world, Rng& rng) {
  // <solution likelyNoise>
  // What the filter does not explain is noise. The better the assumed noise, the better the filter, and with
  // it the noise: four rounds are enough even from a factor of ten.
  CarWorld assumed = world;
  for (int round = 0; round < 4; ++round) {
    Cloud cloud{log.start.replicate(1, 200), Eigen::VectorXd::Constant(200, 1. / 200)};
    double squares = 0, numbers = 0;
    for (std::size_t t = 0; t < log.controls.size(); ++t) {
      cloud = filterStep(cloud, log.controls[t], log.observations[t], assumed, rng);
      squares += (log.observations[t] - viewFrom(meanPose(cloud), assumed)).squaredNorm();
      numbers += static_cast<double>(log.observations[t].size());
    }
    assumed.observationNoise = std::sqrt(squares / numbers);
  }
  return assumed.observationNoise;
  // <todo>
  //| // TODO: how large is what the car saw, without what your filter explains of it?
  //| return world.observationNoise;
  // </solution>
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

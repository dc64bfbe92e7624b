#include <algorithm>
#include <cmath>
#include <numbers>

#include "exercise.h"

using namespace rex;

Eigen::Vector3d carStep(const Eigen::Vector3d& x, const Eigen::Vector2d& u, const CarWorld& world) {
  // TODO: slide 4:48, with a dot over the theta of its third line.
  static_cast<void>(u);
  return x;
}

Eigen::MatrixXd moved(const Eigen::MatrixXd& states, const Eigen::Vector2d& u, const CarWorld& world,
                      Rng& rng) {
  Eigen::MatrixXd next = states;
  // TODO: each column one step on. rng.normal() is one number of standard deviation 1, rng.normalVector(3)
  // are three.
  return next;
}

Eigen::VectorXd viewFrom(const Eigen::Vector3d& x, const CarWorld& world) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(2 * world.landmarks.cols());
  // TODO: the landmarks in the frame of the car. Part 6: their distances and bearings, too.
  static_cast<void>(x);
  return y;
}

Eigen::VectorXd logLikelihoods(const Eigen::MatrixXd& states, const Eigen::VectorXd& y,
                               const CarWorld& world) {
  Eigen::VectorXd logarithms = Eigen::VectorXd::Zero(states.cols());
  // TODO: the logarithm of a normal density, for each particle over all that was seen. How often is a
  // noise of 0.5 off by 1?
  static_cast<void>(y);
  static_cast<void>(world);
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
  static_cast<void>(weights);
  static_cast<void>(rng);
  for (int i = 0; i < count; ++i) parents.push_back(i);
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
  static_cast<void>(u);
  static_cast<void>(y);
  static_cast<void>(world);
  static_cast<void>(rng);
  return after;
}

Eigen::Vector3d meanPose(const Cloud& cloud) {
  // TODO: which direction lies between the headings 3.1 and -3.1?
  static_cast<void>(cloud);
  return Eigen::Vector3d::Zero();
}

double likelyNoise(const DriveLog& log, const CarWorld& world, Rng& rng) {
  // TODO: how large is what the car saw, without what your filter explains of it?
  static_cast<void>(log);
  static_cast<void>(rng);
  return world.observationNoise;
}

// From here on everything is given: the parts of the exercise one after another, with pictures. Change it as
// you like.

int main() {}

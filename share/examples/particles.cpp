// A particle filter finds a robot on a line with two equal doors: it keeps both guesses until the wall tells.
#include "course/course.h"
#include "estimation/particle_filter.h"

using namespace rex;

int main() {
  const double speed = 0.1, drift = 0.02, noise = 0.15;  // m per step, and deviations of step and sensor in m
  const auto distanceToDoor = [](double x) { return std::min(std::abs(x - 2), std::abs(x - 6)); };

  Rng rng(1);
  Eigen::MatrixXd states(1, 2000);  // one particle per column, anywhere on 10 m
  for (double& x : states.reshaped()) x = rng.uniform(0, 10);
  ParticleFilter filter({.states = states, .weights = Eigen::VectorXd::Constant(2000, 1. / 2000)});

  const MotionSampler move = [&](Eigen::Ref<Eigen::MatrixXd> X, Eigen::Ref<Eigen::VectorXd>, Rng& r) {
    for (double& x : X.reshaped()) x += speed + drift * r.normal();
  };
  Series truth{.label = "true position"},
      guesses{.label = "every 20th particle", .style = SeriesStyle::kPoints};
  double robot = 0.5;
  for (int t = 0; t < 60; ++t) {
    robot += speed + drift * rng.normal();
    const double y = distanceToDoor(robot) + noise * rng.normal();
    const LogLikelihood weigh = [&](const MatrixArg& X, Eigen::Ref<Eigen::VectorXd> logWeights) {
      for (Eigen::Index k = 0; k < X.cols(); ++k)
        logWeights[k] -= std::pow((y - distanceToDoor(X(0, k))) / noise, 2) / 2;
    };
    const ParticleStep step = filter.step(move, weigh, rng);
    if (step.lost) print("step that no particle explains", t);
    truth.x.push_back(t), truth.y.push_back(robot);
    for (Eigen::Index k = 0; k < filter.particles().states.cols(); k += 20)
      guesses.x.push_back(t), guesses.y.push_back(filter.particles().states(0, k));
  }
  print("true position [m]", robot);
  print("estimated position [m]", sampleMoments(filter.particles()).mean[0]);
  plot("particles",
       {.title = "One of two doors", .xLabel = "step", .yLabel = "position [m]", .series = {guesses, truth}});
}

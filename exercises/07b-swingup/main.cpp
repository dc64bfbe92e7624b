#include <algorithm>
#include <cmath>
#include <numbers>

#include "exercise.h"
#include "show.h"

using namespace rex;

double valueAt(const Grid& grid, const Eigen::MatrixXd& V, const Eigen::Vector2d& x) {
  // TODO: between which nodes is x, and how far from each of them?
  return 0;
}

Eigen::MatrixXd swept(const Decision& decision, const Eigen::MatrixXd& V) {
  Eigen::MatrixXd swept = Eigen::MatrixXd::Zero(V.rows(), V.cols());
  // TODO: at each node, the least of a step's cost and what comes after it.
  return swept;
}

double bestTorque(const Decision& decision, const Eigen::MatrixXd& V, const Eigen::Vector2d& x) {
  // TODO: which torque of the list leads to the least?
  return 0;
}

std::vector<Eigen::MatrixXd> gainsOverTime(const Plant& plant, const Costs& costs, const Eigen::MatrixXd& F,
                                           int steps) {
  // TODO: from the last step to the first.
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(plant.B.cols(), plant.A.rows());
  return std::vector<Eigen::MatrixXd>(static_cast<std::size_t>(steps), zero);
}

double energyOf(const Pendulum& pendulum, const Eigen::Vector2d& x) {
  // TODO: how fast is the mass, and how high?
  return 0;
}

double pumpTorque(const Pendulum& pendulum, double gain, const Eigen::Vector2d& x) {
  // TODO: what does the torque do to the energy, and what does friction do?
  return 0;
}

std::optional<Eigen::VectorXd> counterexample(const Flow& f, const Eigen::MatrixXd& P,
                                              const Eigen::VectorXd& high, Rng& rng) {
  // TODO: look at many points of the box, and on its axes.
  return {};
}

double levelInside(const Eigen::MatrixXd& P, const Eigen::VectorXd& high) {
  // TODO: where on the ellipsoid of level c is x_i largest?
  return 0;
}

double fallingLevel(const Flow& f, const Eigen::Matrix2d& P, double most) {
  // TODO: where does V begin to rise?
  return 0;
}

Eigen::MatrixXd swungUp(const Pendulum& pendulum, const Swing& swing, const Eigen::Vector2d& start,
                        int steps) {
  // TODO: pump, and catch.
  return start;
}

Eigen::VectorXd costSlope(const Journey& journey, const Eigen::VectorXd& U) {
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(U.size());
  // TODO: from the last state to the first: what would a little more of it cost?
  return slope;
}

Eigen::VectorXd planned(const Journey& journey, const Eigen::VectorXd& U) {
  Eigen::VectorXd best = U;
  // TODO: improve the torques until the slope is zero.
  return best;
}

// What follows is given: the parts of the exercise one after another. show.cpp draws the pictures.
int main() {
  const double pi = std::numbers::pi;
  const Pendulum pendulum;
  const Eigen::Vector2d down(pi, 0), nudged(pi, .01);

  // Part 1: sweep until nothing changes, and follow the best torques.
  const Decision decision{.pendulum = pendulum};
  Eigen::MatrixXd V = Eigen::MatrixXd::Zero(decision.grid.angles, decision.grid.rates);
  int sweeps = 0;
  for (double change = 1; change > 1e-3 && sweeps < 1000; ++sweeps) {
    const Eigen::MatrixXd next = swept(decision, V);
    change = (next - V).cwiseAbs().maxCoeff();
    V = next;
  }
  print("sweeps", sweeps);
  print("cost from hanging at rest", valueAt(decision.grid, V, down));
  print("the same by the library", costByTheLibrary(decision, down));
  Motion byValues{"by values", Eigen::MatrixXd::Zero(2, 801), Eigen::VectorXd::Zero(800), .01};
  byValues.X.col(0) = down;
  // A torque that is best for .05 s is chosen every .01 s.
  for (int t = 0; t < 800; ++t) {
    byValues.U[t] = bestTorque(decision, V, byValues.X.col(t));
    byValues.X.col(t + 1) = nextOf(pendulum, byValues.X.col(t), byValues.U[t], byValues.tau);
  }
  showValues(decision.grid, V, byValues);

  // Part 2: gains for the last three seconds upright.
  showGains(pendulum);

  // Part 3: pumping alone brings the energy to zero, and the pendulum past the top, again and again.
  print("energy from below", energyOf(pendulum, down));
  print("torque that pumps at 1 rad/s there", pumpTorque(pendulum, 1, {pi, 1}));

  // Parts 4 and 5: where the linear controller catches, by boxes and by rays, and the whole motion.
  Swing swing = regulatorOfTheLibrary(pendulum);  // K and P of a linear regulator, see show.h
  const Flow f = flowOf(pendulum, swing.K);       // x' under u = K x, limited to what the motor can
  Eigen::VectorXd high = Eigen::Vector2d(1, 4);
  Rng rng(1);
  for (int i = 0; i < 60 && counterexample(f, swing.P, high, rng); ++i) high *= .9;
  print("level in the largest box in which V falls", levelInside(swing.P, high));
  swing.level = fallingLevel(f, swing.P, 50);
  print("level up to which V falls", swing.level);
  showRegion(pendulum, swing);
  Motion byEnergy{"by energy", swungUp(pendulum, swing, nudged, 800), {}, swing.tau};

  // Part 6: a plan of four seconds from a guess, with 80 torques; the checks have at most 40.
  const Journey journey;
  Eigen::VectorXd guess(80);
  for (int t = 0; t < 80; ++t) guess[t] = std::sin(3 * journey.tau * t);
  const Eigen::VectorXd U = planned(journey, guess);
  print("cost of a guess", priceOf(journey, guess));
  print("cost of the plan", priceOf(journey, U));
  print("the same by the library", priceByTheLibrary(journey, guess));
  print("strongest torque of the plan, which knows no limit", U.cwiseAbs().maxCoeff());
  print("largest slope left, which should be 0", costSlope(journey, U).cwiseAbs().maxCoeff());
  showMotions(pendulum, {byValues, byEnergy, {"planned", statesOf(journey, U), U, journey.tau}});
}

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

double valueAt(const Grid& grid, const Eigen::MatrixXd& V, const Eigen::Vector2d& x) {
  // <solution valueAt>
  const double turn = 2 * std::numbers::pi, share = x[0] / turn + .5;
  const double a = (share - std::floor(share)) * grid.angles;
  const double rate = std::clamp(x[1], -grid.fastest, grid.fastest);
  const double b = (rate / grid.fastest + 1) / 2 * (grid.rates - 1);
  const int cell = static_cast<int>(a), i = cell % grid.angles;
  const int next = (cell + 1) % grid.angles;
  const int j = std::min(static_cast<int>(b), grid.rates - 2);
  const double s = a - cell, t = b - j;
  return (1 - s) * ((1 - t) * V(i, j) + t * V(i, j + 1)) + s * ((1 - t) * V(next, j) + t * V(next, j + 1));
  // <todo>
  //| // TODO: between which nodes is x, and how far from each of them?
  //| return 0;
  // </solution>
}

Eigen::MatrixXd swept(const Decision& decision, const Eigen::MatrixXd& V) {
  Eigen::MatrixXd swept = Eigen::MatrixXd::Zero(V.rows(), V.cols());
  // <solution swept>
  const Grid& grid = decision.grid;
  for (int i = 0; i < grid.angles; ++i)
    for (int j = 0; j < grid.rates; ++j) {
      const double angle = (2. * i / grid.angles - 1) * std::numbers::pi;
      const double rate = (2. * j / (grid.rates - 1) - 1) * grid.fastest;
      const Eigen::Vector2d x(angle, rate);
      const double u = bestTorque(decision, V, x);
      const double after = valueAt(grid, V, nextOf(decision.pendulum, x, u, decision.tau));
      swept(i, j) = decision.tau * costOf(x, u, decision.effort) + decision.discount * after;
    }
  // <todo>
  //| // TODO: at each node, the least of a step's cost and what comes after it.
  // </solution>
  return swept;
}

double bestTorque(const Decision& decision, const Eigen::MatrixXd& V, const Eigen::Vector2d& x) {
  // <solution bestTorque>
  double best = 0, least = INFINITY;
  for (int k = 0; k < decision.torques; ++k) {
    const double u = (2. * k / (decision.torques - 1) - 1) * decision.pendulum.strongest;
    const Eigen::Vector2d next = nextOf(decision.pendulum, x, u, decision.tau);
    const double after = decision.discount * valueAt(decision.grid, V, next);
    const double total = decision.tau * costOf(x, u, decision.effort) + after;
    if (total < least) best = u, least = total;
  }
  return best;
  // <todo>
  //| // TODO: which torque of the list leads to the least?
  //| return 0;
  // </solution>
}

std::vector<Eigen::MatrixXd> gainsOverTime(const Plant& plant, const Costs& costs, const Eigen::MatrixXd& F,
                                           int steps) {
  // <solution gainsOverTime>
  const Eigen::MatrixXd At = plant.A.transpose(), Bt = plant.B.transpose();
  std::vector<Eigen::MatrixXd> K(static_cast<std::size_t>(steps));
  Eigen::MatrixXd P = F;
  for (auto k = K.rbegin(); k != K.rend(); ++k) {
    const Eigen::MatrixXd PA = P * plant.A, PB = P * plant.B, M = Bt * PB;
    *k = -solveMatrix(costs.R + M, Bt * PA);
    const Eigen::MatrixXd PBK = PB * *k, both = PA + PBK;
    P = costs.Q + At * both;
    P = .5 * (P + P.transpose()).eval();  // else rounding grows over a long time
  }
  return K;
  // <todo>
  //| // TODO: from the last step to the first.
  //| const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(plant.B.cols(), plant.A.rows());
  //| return std::vector<Eigen::MatrixXd>(static_cast<std::size_t>(steps), zero);
  // </solution>
}

double energyOf(const Pendulum& pendulum, const Eigen::Vector2d& x) {
  // <solution energyOf>
  const double speed = pendulum.length * x[1], height = pendulum.length * (std::cos(x[0]) - 1);
  return pendulum.mass * (speed * speed / 2 + pendulum.g * height);
  // <todo>
  //| // TODO: how fast is the mass, and how high?
  //| return 0;
  // </solution>
}

double pumpTorque(const Pendulum& pendulum, double gain, const Eigen::Vector2d& x) {
  // <solution pumpTorque>
  const double wanted = (pendulum.friction - gain * energyOf(pendulum, x)) * x[1];
  return std::clamp(wanted, -pendulum.strongest, pendulum.strongest);
  // <todo>
  //| // TODO: what does the torque do to the energy, and what does friction do?
  //| return 0;
  // </solution>
}

std::optional<Eigen::VectorXd> counterexample(const Flow& f, const Eigen::MatrixXd& P,
                                              const Eigen::VectorXd& high, Rng& rng) {
  // <solution counterexample>
  const auto isOne = [&](const Eigen::VectorXd& x) {
    const Eigen::VectorXd Px = P * x;
    return x.dot(Px) <= 0 || Px.dot(f(x)) >= 0;
  };
  const auto n = static_cast<int>(high.size());
  for (int axis = 0; axis < n; ++axis)
    for (int part = -20; part <= 20; ++part) {
      if (part == 0) continue;
      Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
      x[axis] = part / 20. * high[axis];
      if (isOne(x)) return x;
    }
  for (int k = 0; k < 10000; ++k) {
    const Eigen::VectorXd x = high.cwiseProduct(rng.uniformVector(n, -1, 1));
    if (isOne(x)) return x;
  }
  return {};
  // <todo>
  //| // TODO: look at many points of the box, and on its axes.
  //| return {};
  // </solution>
}

double levelInside(const Eigen::MatrixXd& P, const Eigen::VectorXd& high) {
  // <solution levelInside>
  const Eigen::MatrixXd inverseP = inverse(P);
  double level = INFINITY;
  for (Eigen::Index i = 0; i < high.size(); ++i) level = std::min(level, high[i] * high[i] / inverseP(i, i));
  return level;
  // <todo>
  //| // TODO: where on the ellipsoid of level c is x_i largest?
  //| return 0;
  // </solution>
}

double fallingLevel(const Flow& f, const Eigen::Matrix2d& P, double most) {
  // <solution fallingLevel>
  // On the ellipse of level c lie the points sqrt(c) L^-T (cos, sin) with P = L L^T.
  const double a = std::sqrt(P(0, 0)), b = P(1, 0) / a, d = std::sqrt(P(1, 1) - b * b);
  constexpr int kRays = 400, kPlaces = 100;
  double level = most;
  for (int k = 0; k < 2 * kRays; ++k) {
    const double angle = 2 * std::numbers::pi * k / kRays, y = std::sin(angle) / d;
    const Eigen::Vector2d ray((std::cos(angle) - b * y) / a, y), up = P * ray;
    for (int i = 1; i <= kPlaces; ++i) {
      const double c = level * i / kPlaces;
      if (up.dot(f(std::sqrt(c) * ray)) < 0) continue;
      level = c;
      break;
    }
  }
  return .99 * level;
  // <todo>
  //| // TODO: where does V begin to rise?
  //| return 0;
  // </solution>
}

Eigen::MatrixXd swungUp(const Pendulum& pendulum, const Swing& swing, const Eigen::Vector2d& start,
                        int steps) {
  // <solution swungUp>
  Eigen::MatrixXd states(2, steps + 1);
  states.col(0) = start;
  for (int step = 0; step < steps; ++step) {
    const Eigen::Vector2d now = states.col(step);
    const Eigen::Vector2d x(std::remainder(now[0], 2 * std::numbers::pi), now[1]), Px = swing.P * x;
    double u = pumpTorque(pendulum, swing.gain, x);
    if (x.dot(Px) < swing.level) u = std::clamp(swing.K.dot(x), -pendulum.strongest, pendulum.strongest);
    states.col(step + 1) = nextOf(pendulum, now, u, swing.tau);
  }
  return states;
  // <todo>
  //| // TODO: pump, and catch.
  //| return start;
  // </solution>
}

Eigen::VectorXd costSlope(const Journey& journey, const Eigen::VectorXd& U) {
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(U.size());
  // <solution costSlope>
  const Eigen::MatrixXd X = statesOf(journey, U);
  Eigen::Vector2d worth(0, 0);  // what a little more of the state costs: lambda
  for (Eigen::Index t = U.size(); t >= 0; --t) {
    const Eigen::Vector2d x = X.col(t), ofCost(2 * std::sin(x[0]), .1 * x[1]);
    if (t == U.size()) {
      worth = journey.last * ofCost;
      continue;
    }
    const Plant step = stepNear(journey.pendulum, x, U[t], journey.tau);
    slope[t] = 2 * journey.tau * journey.effort * U[t] + step.B.col(0).dot(worth);
    const Eigen::Vector2d through = step.A.transpose() * worth;
    worth = journey.tau * ofCost + through;
  }
  // <todo>
  //| // TODO: from the last state to the first: what would a little more of it cost?
  // </solution>
  return slope;
}

Eigen::VectorXd planned(const Journey& journey, const Eigen::VectorXd& U) {
  Eigen::VectorXd best = U;
  // <solution planned>
  const Eigen::Index N = U.size();
  for (int k = 0; k < 500 && costSlope(journey, best).cwiseAbs().maxCoeff() > 1e-5; ++k) {
    const Eigen::MatrixXd X = statesOf(journey, best);
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2, N), P = Eigen::MatrixXd::Zero(2, 2);
    Eigen::VectorXd change = Eigen::VectorXd::Zero(N);
    Eigen::Vector2d p(0, 0);
    for (Eigen::Index t = N; t >= 0; --t) {
      const double weight = t == N ? journey.last : journey.tau, c = std::cos(X(0, t)), s = std::sin(X(0, t));
      Eigen::Vector2d slope = weight * Eigen::Vector2d(2 * s, .1 * X(1, t));
      Eigen::MatrixXd bend = weight * Eigen::Vector2d(1 + c, .1).asDiagonal().toDenseMatrix();
      if (t < N) {
        const Plant step = stepNear(journey.pendulum, X.col(t), best[t], journey.tau);
        const Eigen::MatrixXd PB = P * step.B, PA = P * step.A, APB = step.A.transpose() * PB,
                              APA = step.A.transpose() * PA;
        const Eigen::Vector2d b = step.B.col(0), Ap = step.A.transpose() * p, coupling = APB.col(0);
        const double bendU = 2 * journey.tau * journey.effort + b.dot(PB.col(0));
        const double slopeU = 2 * journey.tau * journey.effort * best[t] + b.dot(p);
        change[t] = -slopeU / bendU;
        K.col(t) = -coupling / bendU;
        slope += Ap + coupling * change[t];
        bend += APA + coupling * K.col(t).transpose();
      }
      p = slope, P = bend;
    }
    const double price = priceOf(journey, best);
    for (double share = 1; share > 1e-9; share /= 2) {
      Eigen::VectorXd next = best;
      Eigen::Vector2d x = journey.start;
      for (Eigen::Index t = 0; t < next.size(); ++t) {
        next[t] += share * change[t] + K.col(t).dot(x - X.col(t));
        x = nextOf(journey.pendulum, x, next[t], journey.tau);
      }
      if (priceOf(journey, next) >= price) continue;
      best = next;
      break;
    }
  }
  // <todo>
  //| // TODO: improve the torques until the slope is zero.
  // </solution>
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

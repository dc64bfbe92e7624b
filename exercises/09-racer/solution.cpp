#include <algorithm>
#include <cmath>

#include "control/racer_rollouts.h"
#include "control/regulators.h"
#include "course/racer_pictures.h"
#include "course/search_cma.h"
#include "exercise.h"
#include "lessons.h"

using namespace rex;

// Keeps the compiler quiet about what a function below does not use yet.
template <class... Unused>
void notUsedYet(const Unused&...) {}

Eigen::Matrix2d massMatrix(const Eigen::Vector2d& q, const RacerModel& racer) {
  // <solution massMatrix>
  const double mixed = racer.mB * racer.l * std::cos(q[1]);
  Eigen::Matrix2d M;
  M << racer.mA + racer.mB + racer.IA / (racer.r * racer.r), mixed, mixed,
      racer.mB * racer.l * racer.l + racer.IB;
  return M;
  // <todo>
  //| // TODO: kinetic energy is q'^T M q' / 2. What do the wheel and the pendulum have of it?
  //| notUsedYet(q, racer);
  //| return Eigen::Matrix2d::Identity();
  // </solution>
}

Eigen::Vector2d forceTerm(const Eigen::Vector2d& q, const Eigen::Vector2d& v, const RacerModel& racer) {
  // <solution forceTerm>
  const double swing = racer.mB * racer.l * std::sin(q[1]);
  return {-swing * v[1] * v[1], -swing * racer.g};
  // <todo>
  //| // TODO: what d/dt dT/dq' - dT/dq + dU/dq has besides M q''.
  //| notUsedYet(q, v, racer);
  //| return Eigen::Vector2d::Zero();
  // </solution>
}

Eigen::Vector2d controlDirection(const RacerModel& racer) {
  // <solution controlDirection>
  return {1 / racer.r, -1};
  // <todo>
  //| // TODO: the work of the motor is u times the angle between wheel and pendulum.
  //| notUsedYet(racer);
  //| return Eigen::Vector2d::Zero();
  // </solution>
}

double energyOf(const Eigen::Vector4d& x, const RacerModel& racer) {
  // <solution energyOf>
  const Eigen::Vector2d v = x.tail<2>();
  return v.dot(massMatrix(x.head<2>(), racer) * v) / 2 +
         racer.g * (racer.mA * racer.r + racer.mB * (racer.r + racer.l * std::cos(x[1])));
  // <todo>
  //| // TODO: T + U.
  //| notUsedYet(x, racer);
  //| return 0;
  // </solution>
}

Eigen::Vector4d rateOf(const Eigen::Vector4d& x, double u, const RacerModel& racer) {
  // <solution rateOf>
  const Eigen::Vector2d q = x.head<2>(), v = x.tail<2>();
  Eigen::Vector4d rate;
  rate << v, massMatrix(q, racer).inverse() * (controlDirection(racer) * u - forceTerm(q, v, racer));
  return rate;
  // <todo>
  //| // TODO: the velocities, and the accelerations that solve M q'' + F = B u.
  //| notUsedYet(u, racer);
  //| return 0 * x;
  // </solution>
}

Eigen::Vector4d stepped(const Eigen::Vector4d& x, double u, double tau, const RacerModel& racer) {
  // <solution stepped>
  const Eigen::Vector4d k1 = rateOf(x, u, racer), k2 = rateOf(x + tau / 2 * k1, u, racer),
                        k3 = rateOf(x + tau / 2 * k2, u, racer), k4 = rateOf(x + tau * k3, u, racer);
  return x + tau / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  // <todo>
  //| // TODO: four rates and their weighted mean.
  //| notUsedYet(u, tau, racer);
  //| return x;
  // </solution>
}

Eigen::MatrixXd kicks(int steps, double tau, double noise, Rng& rng) {
  // <solution kicks>
  return std::sqrt(tau) * noise * rng.normalVector(2 * steps).reshaped(2, steps);
  // <todo>
  //| // TODO: normal numbers of the right deviation; `rng` has some.
  //| notUsedYet(tau, noise, rng);
  //| return Eigen::MatrixXd::Zero(2, steps);
  // </solution>
}

Linear linearNearRest(const RacerModel& racer) {
  // <solution linearNearRest>
  constexpr double h = 2e-5;
  Linear linear;
  for (int row = 0; row < 4; ++row) {
    const Eigen::Vector4d dx = h * Eigen::Vector4d::Unit(row);
    linear.A.col(row) = (rateOf(dx, 0, racer) - rateOf(-dx, 0, racer)) / (2 * h);
  }
  linear.B =
      (rateOf(Eigen::Vector4d::Zero(), h, racer) - rateOf(Eigen::Vector4d::Zero(), -h, racer)) / (2 * h);
  return linear;
  // <todo>
  //| // TODO: the derivatives of rateOf() by the state and by u, at rest upright.
  //| notUsedYet(racer);
  //| return {Eigen::Matrix4d::Zero(), Eigen::Vector4d::Zero()};
  // </solution>
}

Eigen::Vector4d lqrGain(const Linear& system, const Eigen::Matrix4d& Q, double R) {
  // <solution lqrGain>
  // The sign of the Hamiltonian matrix is -1 on its stable half, which is spanned by (1; P).
  Eigen::MatrixXd Z(8, 8);
  Z << system.A, -system.B * system.B.transpose() / R, -Q, -system.A.transpose();
  for (int i = 0; i < 60; ++i) Z = (Z + inverse(Z)).eval() / 2;
  Z.diagonal().array() += 1;
  Eigen::Vector4d K;
  for (int row = 0; row < 4; ++row) {
    const Eigen::VectorXd columnOfP = leastSquares(Z.rightCols(4), -Z.col(row));
    K[row] = system.B.dot(columnOfP) / R;
  }
  return K;
  // <todo>
  //| // TODO: the P of 0 = A^T P + P A - P B B^T P / R + Q, and what K is then. inverse(), solve() may help.
  //| notUsedYet(system, Q, R);
  //| return Eigen::Vector4d::Zero();
  // </solution>
}

Eigen::VectorXd featuresAt(const Eigen::Vector4d& y, const Eigen::VectorXd& before, double u, double tau) {
  // <solution featuresAt>
  const bool isFirst = before.size() == 0;
  Eigen::VectorXd now = Eigen::VectorXd::Zero(kFeatures);
  now[0] = 1;
  now.segment<4>(1) = now.segment<4>(9) = now.segment<4>(17) = y;
  if (isFirst) return now;
  now.segment<4>(5) = (y - before.segment<4>(1)) / tau;
  now.segment<8>(9) = .5 * before.segment<8>(9) + .5 * now.segment<8>(1);
  now.segment<8>(17) = .9 * before.segment<8>(17) + .1 * now.segment<8>(1);
  now[25] = u;
  now[26] = before[25];
  return now;
  // <todo>
  //| // TODO: 27 numbers, those of the first reading apart.
  //| notUsedYet(y, before, u, tau);
  //| return Eigen::VectorXd::Zero(kFeatures);
  // </solution>
}

Ride rideOf(const Eigen::VectorXd& w, const Eigen::Vector4d& start, const Eigen::MatrixXd& noise,
            const RacerModel& racer, const RacerSensors& sensors) {
  // <solution rideOf>
  const Eigen::Index T = noise.cols();
  Ride ride{Eigen::MatrixXd(4, T + 1), Eigen::VectorXd(T), 0};
  ride.states.col(0) = start;
  Eigen::Vector4d x = start;
  Eigen::VectorXd features;
  double u = 0;
  Eigen::Index n = 0;
  for (bool stands = true; stands && n < T; ++n) {
    features = featuresAt(sensors.measured(x, racer.r), features, u, kTau);
    u = std::clamp(w.dot(features), -kLargestControl, kLargestControl);
    x = stepped(x, u, kTau, racer);
    x.tail<2>() += noise.col(n);
    ride.controls[n] = u;
    ride.states.col(n + 1) = x;
    stands = std::abs(x[1]) <= kLargestAngle;
    ride.cost += stands ? x[0] * x[0] + 10 * x[1] * x[1] : kCostOfMissing * static_cast<double>(T - n);
  }
  ride.states.conservativeResize(4, n + 1);
  ride.controls.conservativeResize(n);
  return ride;
  // <todo>
  //| // TODO: step by step, until the time is over or the racer has failed.
  //| notUsedYet(w, noise, racer, sensors);
  //| return {start, Eigen::VectorXd(0), 0};
  // </solution>
}

Eigen::VectorXd searchedPolicy(const Rides& rides, int budget, Rng& rng) {
  // <solution searchedPolicy>
  constexpr int kSearches = 3, kSamples = 20, kRepeats = 4, kTests = 50, kSearched = 9;
  // Of 1, y and its rates: these tell how fast the wheel turns, and are a hundred times as large.
  Eigen::VectorXd deviations = Eigen::VectorXd::Constant(kSearched, .3);
  deviations.tail(4) *= kTau;
  const int generations = (budget / kSearches - kTests) / (kSamples * kRepeats);
  Eigen::MatrixXd found = Eigen::MatrixXd::Zero(kFeatures, kSearches);
  for (int k = 0; k < kSearches; ++k) {
    SearchCma cma(rng.next());
    cma.init(Eigen::VectorXd::Zero(kSearched), -1, kSamples, deviations);
    Eigen::MatrixXd samples, W = Eigen::MatrixXd::Zero(kFeatures, kSamples);
    Eigen::VectorXd values;
    for (int i = 0; i < generations; ++i) {
      cma.step(samples, values);
      W.topRows(kSearched) = samples.transpose();
      const int steps = std::min(kLongestRide, static_cast<int>(50 * std::pow(30., 1. * i / generations)));
      values.setZero();
      for (int j = 0; j < kRepeats; ++j) values += rides(W, steps);
    }
    cma.step(samples, values);
    found.col(k).head(kSearched) = cma.getMean();
  }
  Eigen::VectorXd costs = Eigen::VectorXd::Zero(kSearches);
  for (int j = 0; j < kTests; ++j) costs += rides(found, kLongestRide);
  int best = 0;
  costs.minCoeff(&best);
  return found.col(best);
  // <todo>
  //| // TODO: SearchCma proposes, rides() judges. Which features, how far away, how many steps, how often?
  //| notUsedYet(rides, budget, rng);
  //| return Eigen::VectorXd::Zero(kFeatures);
  // </solution>
}

// What follows is given.

namespace {

// Weights of (1, y) alone, found by a long search.
Eigen::VectorXd directPolicy() {
  Eigen::VectorXd w = Eigen::VectorXd::Zero(kFeatures);
  w.head(5) << -.1087, -4.83, 30.02, .295, .4098;
  return w;
}

// Without control: your energy along your simulation, and along that of Euler.
void showEnergy() {
  const RacerModel racer;
  Series runge{.label = "Runge and Kutta"}, euler{.label = "Euler"};
  Eigen::Vector4d x = tilted(.01), y = x;
  const double start = energyOf(x, racer);
  for (int t = 0; t < 1000; ++t) {
    for (Series* series : {&runge, &euler}) series->x.push_back(t * kTau);
    runge.y.push_back(std::abs(energyOf(x, racer) - start) + 1e-9);
    euler.y.push_back(std::abs(energyOf(y, racer) - start) + 1e-9);
    x = stepped(x, 0, kTau, racer);
    y += kTau * rateOf(y, 0, racer);
  }
  plot("energy", {.title = "Energy without control: how wrong it gets in 10 s",
                  .xLabel = "time [s]",
                  .yLabel = "error of the energy [J]",
                  .logY = true,
                  .series = {runge, euler}});
}

// The state of a racer under u = -K x, by your simulation.
Eigen::MatrixXd heldBy(const Eigen::Vector4d& K, double theta, const Eigen::MatrixXd& noise) {
  Eigen::MatrixXd X(4, noise.cols() + 1);
  X.col(0) = tilted(theta);
  for (Eigen::Index t = 0; t < noise.cols(); ++t) {
    X.col(t + 1) =
        stepped(X.col(t), std::clamp(-K.dot(X.col(t)), -kLargestControl, kLargestControl), kTau, {});
    X.col(t + 1).tail(2) += noise.col(t);
  }
  return X;
}

void showLqr(const Eigen::Vector4d& K, const Eigen::Vector4d& exact) {
  Rng rng(1);
  const Eigen::MatrixXd noise = kicks(500, kTau, kNoise, rng);
  Figure figure{
      .title = "LQR with noise, from a tilt of 0.2 rad", .xLabel = "time [s]", .yLabel = "[m], [rad]"};
  const auto add = [&](const std::string& whose, const Eigen::MatrixXd& X, bool dashed) {
    for (const int i : {0, 1}) {
      Series series{.label = (i == 0 ? "x, " : "theta, ") + whose, .dashed = dashed};
      if (dashed) series.color = Color{.2f, .22f, .26f};
      for (Eigen::Index t = 0; t < X.cols(); ++t) {
        series.x.push_back(kTau * static_cast<double>(t));
        series.y.push_back(X(i, t));
      }
      figure.series.push_back(series);
    }
  };
  add("your gain", heldBy(K, .2, noise), false);
  add("the library's gain", heldBy(exact, .2, noise), true);
  plot("lqr", figure);
}

void showLearning(const Lesson& yours, const Library& library) {
  LearningCurves curves{"ten searches, in the library's simulator", {}};
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Rng rng(seed);
    curves.runs.push_back(curveOf(learnt(ridesOf(library, rng), seed)));
  }
  Figure figure = learningFigure({curves});
  figure.series.push_back({.label = "one search, in your simulator", .y = curveOf(yours)});
  figure.title = "What a step of a ride costs while the search goes on";
  figure.xLabel = "share of the rides [%]";
  figure.yLabel = "cost per step";
  figure.logY = true;
  const auto inPercent = [](std::vector<double>& x, std::size_t count) {
    x.clear();
    for (std::size_t i = 0; i < count; ++i) x.push_back(2. * static_cast<double>(i) + 1);
  };
  for (Series& series : figure.series) inPercent(series.x, series.y.size());
  for (Band& band : figure.bands) inPercent(band.x, band.low.size());
  plot("learning", figure);
}

// How far the wheel gets from where it began: root mean square of some long rides, until one fails.
Series driftOf(const std::string& label, const Eigen::VectorXd& w) {
  constexpr int kRides = 10, kSteps = 10000;
  Rng rng(2);
  Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(kSteps / 50);
  for (int i = 0; i < kRides; ++i) {
    const Ride ride = rideOf(w, tilted(.1), kicks(kSteps, kTau, kNoise, rng), {}, {});
    squares.conservativeResize(std::min(squares.size(), (ride.states.cols() + 49) / 50));
    for (Eigen::Index k = 0; k < squares.size(); ++k)
      squares[k] += std::pow(ride.states(0, 50 * k), 2) / kRides;
  }
  Series series{.label = label};
  for (Eigen::Index k = 0; k < squares.size(); ++k) {
    series.x.push_back(50 * kTau * static_cast<double>(k));
    series.y.push_back(std::sqrt(squares[k]));
  }
  return series;
}

void showPolicies(const Lesson& lesson, const Library& library) {
  plot("drift",
       {.title = "Without a sense for the wheel's speed, a racer sways more and more",
        .xLabel = "time [s]",
        .yLabel = "root mean square of x [m]",
        .series = {driftOf("a policy on (1, y)", directPolicy()), driftOf("your policy", lesson.policy)}});
  Figure figure{.title = "Rides that last 5 s",
                .xLabel = "strength of the noise",
                .yLabel = "share",
                .legend = Legend::kOutside};
  const auto add = [&](const std::string& label, const Eigen::VectorXd& w) {
    Series series{.label = label, .style = SeriesStyle::kLinesPoints};
    for (double noise = 0; noise < 2.05; noise += .1) {
      series.x.push_back(noise);
      series.y.push_back(shareThatLasts(library, w, noise));
    }
    figure.series.push_back(series);
  };
  add("a policy on (1, y)", directPolicy());
  add("your policy", lesson.policy);
  add("without control", Eigen::VectorXd::Zero(kFeatures));
  plot("robust", figure);
}

// Before, on the way and after, side by side; who fails stays as it is then.
void showFilm(const Lesson& lesson) {
  Rng rng(4);
  const Eigen::MatrixXd noise = kicks(kLongestRide, kTau, kNoise, rng);
  std::vector<Eigen::MatrixXd> rides;
  for (const Eigen::VectorXd& w :
       {Eigen::VectorXd(Eigen::VectorXd::Zero(kFeatures)), lesson.halfTaught, lesson.policy})
    rides.push_back(rideOf(w, tilted(.15), noise, {}, {}).states);
  std::vector<RacerView> views;
  for (int t = 0; t <= kLongestRide; t += 2) {
    RacerView view{.x = Eigen::Matrix4Xd(4, 3), .names = {"before", "1000 rides", "after"}};
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::MatrixXd& X = rides[static_cast<std::size_t>(k)];
      view.x.col(k) = X.col(std::min<Eigen::Index>(t, X.cols() - 1));
    }
    view.caption = "policy search";
    views.push_back(view);
  }
  writeFilm(views, "learnt", {.view = {1.2, -1.6, .7}, .step = 2 * kTau});
}

}  // namespace

int main() {
  const RacerModel racer;
  const RacerDynamics library;
  const Eigen::Vector2d q(.3, .7), v(-1.1, 2.3);
  print("M", massMatrix(q, racer));
  print("M of the library", library.massMatrix(q));
  print("F", forceTerm(q, v, racer).transpose());
  print("F of the library", library.forces(q, v).transpose());
  showEnergy();

  const Eigen::Matrix4d Q = Eigen::Vector4d(1, 10, 0, 0).asDiagonal();
  const LinearizedPlant plant = library.linearized(Eigen::Vector4d::Zero(), 0);
  const Eigen::Vector4d exact =
      lqr({.A = plant.A, .B = plant.B}, Q, Eigen::Matrix<double, 1, 1>::Ones()).K.transpose();
  const Linear linear = linearNearRest(racer);
  const bool isLinear = linear.A.norm() > 0;
  const Eigen::Vector4d K = isLinear ? lqrGain(linear, Q, 1) : Eigen::Vector4d::Zero();
  print("K", K.transpose());
  print("K of the library", exact.transpose());
  showLqr(K, exact);

  Rng rng(7);
  const Lesson lesson = learnt(ridesOfYours(rng), 0);
  print("rides of the search", static_cast<double>(lesson.costs.size()));
  print("weights of 1, y and its rates", lesson.policy.head(9).transpose());
  const Library rollouts = [](const Eigen::MatrixXd& W, const std::vector<Trial>& trials,
                              const RacerRolloutOptions& options) {
    return racerRollouts(W, trials, options);
  };
  showPolicies(lesson, rollouts);
  showFilm(lesson);
  if (lesson.costs.size() < 1000) {
    print("no learning.png: it needs a search of 1000 rides, more than",
          static_cast<double>(lesson.costs.size()));
  } else {
    showLearning(lesson, rollouts);
  }
}

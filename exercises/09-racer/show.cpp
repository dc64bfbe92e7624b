#include "show.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "control/racer_rollouts.h"
#include "control/regulators.h"
#include "course/mdp_figures.h"
#include "course/racer_pictures.h"
#include "course/search_cma.h"

using namespace rex;

namespace {

// A start at rest for a ride.
Eigen::Vector4d tilted(double theta) { return {0, theta, 0, 0}; }

// x and theta of the columns of X, one for each step.
void addMotion(Figure& figure, const std::string& whose, const Eigen::MatrixXd& X, bool dashed = false) {
  for (const int i : {0, 1}) {
    Series look{.label = (i == 0 ? "x" : "theta") + whose, .dashed = dashed};
    if (dashed) look.color = Color{.2f, .22f, .26f};
    figure.series.push_back(overTime(X.row(i), kTau, look));
  }
}

// The state of a racer under u = -K x, in your simulation.
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

// Costs of rides of policies on all features in the simulator of the library, which runs eight at once.
Rollouts ridden(const Eigen::MatrixXd& W, const std::vector<Trial>& trials, double noise, int steps) {
  return racerRollouts(
      W, trials,
      {.features = {.rates = true, .averages = true, .averagedRates = true, .controls = true},
       .steps = steps,
       .noise = noise});
}

Rides ridesOfLibrary(Rng& rng) {
  return [&rng](const Eigen::MatrixXd& W, int steps) {
    const std::vector<Trial> trial{{tilted(rng.uniform(-.2, .2)), rng.next()}};
    return Eigen::VectorXd(ridden(W, trial, kNoise, steps).cost.row(0).transpose());
  };
}

// What the sensors read after the steps of a ride that did not fail.
Eigen::MatrixXd readingsOf(const Ride& ride) {
  const RacerModel racer;
  Eigen::Index n = ride.controls.size();
  if (n > 0 && std::abs(ride.states(1, n)) > kLargestAngle) --n;
  Eigen::MatrixXd Y(4, n);
  for (Eigen::Index t = 0; t < n; ++t) Y.col(t) = RacerSensors{}.measured(ride.states.col(t + 1), racer.r);
  return Y;
}

Rides ridesOfYours(Rng& rng, bool bySensors = false) {
  return [&rng, bySensors](const Eigen::MatrixXd& W, int steps) {
    const Eigen::Vector4d start = tilted(rng.uniform(-.2, .2));
    const Eigen::MatrixXd noise = kicks(steps, kTau, kNoise, rng);
    Eigen::VectorXd costs(W.cols());
    for (Eigen::Index i = 0; i < W.cols(); ++i) {
      const Ride ride = rideOf(W.col(i), start, noise, {}, {});
      costs[i] = bySensors ? sensedCost(readingsOf(ride), steps) : ride.cost;
    }
    return costs;
  };
}

// The result of a search.
struct Lesson {
  Eigen::VectorXd policy;
  Eigen::VectorXd halfTaught;      // the best of one call after the first thousand rides
  std::vector<double> costs = {};  // per step, of each ride
};

Lesson learnt(const Rides& rides, std::uint64_t seed) {
  Rng rng(seed);
  Lesson lesson{Eigen::VectorXd::Zero(kFeatures), Eigen::VectorXd::Zero(kFeatures)};
  const Rides recorded = [&](const Eigen::MatrixXd& W, int steps) {
    const Eigen::VectorXd costs = rides(W, steps);
    int cheapest = 0;
    costs.minCoeff(&cheapest);
    if (lesson.costs.size() < 1000) lesson.halfTaught = W.col(cheapest);
    for (const double cost : costs) lesson.costs.push_back(cost / steps);
    return costs;
  };
  lesson.policy = searchedPolicy(recorded, kBudget, rng);
  return lesson;
}

// Means of 50 equal shares of the rides.
std::vector<double> curveOf(const Lesson& lesson) {
  constexpr std::size_t kShares = 50;
  const std::size_t count = lesson.costs.size();
  std::vector<double> curve(kShares, 0);
  for (std::size_t k = 0; k < kShares; ++k) {
    const std::size_t begin = k * count / kShares, end = (k + 1) * count / kShares;
    for (std::size_t i = begin; i < end; ++i) curve[k] += lesson.costs[i] / static_cast<double>(end - begin);
  }
  return curve;
}

void showLearning(const Lesson& yours) {
  LearningCurves curves{"ten searches, in the library's simulator", {}};
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Rng rng(seed);
    curves.runs.push_back(curveOf(learnt(ridesOfLibrary(rng), seed)));
  }
  Figure figure = learningFigure({curves});
  figure.series.push_back({.label = "one search, in your simulator", .y = curveOf(yours)});
  figure.title = "Cost per step of a ride during the search";
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

// The distance of the wheel from its start: root mean square over some long rides, until one fails.
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
  return overTime(squares.sqrt().eval(), 50 * kTau, {.label = label});
}

// The share of 200 rides that last all 500 steps, with more and more noise.
Series robustnessOf(const std::string& label, const Eigen::VectorXd& w) {
  std::vector<Trial> trials;
  for (std::uint64_t seed = 0; seed < 200; ++seed) trials.push_back({tilted(seed % 2 == 0 ? .2 : -.2), seed});
  Series series{.label = label, .style = SeriesStyle::kLinesPoints};
  for (double noise = 0; noise < 2.05; noise += .1) {
    const Rollouts rollouts = ridden(w, trials, noise, kLongestRide);
    series.add(noise, (rollouts.steps.array() == kLongestRide).cast<double>().mean());
  }
  return series;
}

// Before, during and after the search, side by side; a racer that has failed stays as it is.
void showFilm(const Lesson& lesson) {
  Rng rng(4);
  const Eigen::MatrixXd noise = kicks(kLongestRide, kTau, kNoise, rng);
  std::vector<Eigen::MatrixXd> rides;
  for (const Eigen::VectorXd& w :
       {Eigen::VectorXd(Eigen::VectorXd::Zero(kFeatures)), lesson.halfTaught, lesson.policy})
    rides.push_back(rideOf(w, tilted(.15), noise, {}, {}).states);
  Film film;
  for (int t = 0; t <= kLongestRide; t += 2) {
    RacerView view{
        .x = Eigen::Matrix4Xd(4, 3), .names = {"before", "1000 rides", "after"}, .caption = "policy search"};
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::MatrixXd& X = rides[static_cast<std::size_t>(k)];
      view.x.col(k) = X.col(std::min<Eigen::Index>(t, X.cols() - 1));
    }
    film.push_back({t * kTau, racerPicture(view)});
  }
  writeFilm(film, "learnt", {.view = {1.2, -1.6, .7}});
}

}  // namespace

void showEquation(const RacerModel& racer, const Eigen::Vector4d& x) {
  const RacerDynamics library;
  const Eigen::Vector2d q = x.head(2), v = x.tail(2);
  print("M", massMatrix(q, racer));
  print("M of the library", library.massMatrix(q));
  print("F", forceTerm(q, v, racer).transpose());
  print("F of the library", library.forces(q, v).transpose());
  print("B", controlDirection(racer).transpose());
  print("energy [J]", energyOf(x, racer));
  print("energy of the library [J]", library.energy(x));
}

void showEnergy(const RacerModel& racer, double tilt) {
  std::vector<double> runge, euler;
  Eigen::Vector4d x = tilted(tilt), y = x;
  if (stepped(x, 0, kTau, racer) == x) return nothingYet("the simulation");
  const double start = energyOf(x, racer);
  for (int t = 0; t < 1000; ++t) {
    runge.push_back(std::abs(energyOf(x, racer) - start) + 1e-9);
    euler.push_back(std::abs(energyOf(y, racer) - start) + 1e-9);
    x = stepped(x, 0, kTau, racer);
    y += kTau * rateOf(y, 0, racer);
  }
  plot("energy", {.title = "Energy without control: its error over 10 s",
                  .xLabel = "time [s]",
                  .yLabel = "energy error [J]",
                  .logY = true,
                  .series = {overTime(runge, kTau, {.label = "Runge-Kutta"}),
                             overTime(euler, kTau, {.label = "Euler"})}});

  Rng rng(3);
  double spread = 0;
  for (int i = 0; i < 1000; ++i) spread += kicks(100, kTau, kNoise, rng).rowwise().sum().squaredNorm();
  std::printf("Noise of one second: deviation %.3f, wanted %.3f.\n", std::sqrt(spread / 2000), kNoise);
}

void showLqr(const Linear& system, const Eigen::Matrix4d& Q, double R) {
  if (system.A.isZero()) return nothingYet("LQR");
  const Eigen::Vector4d K = lqrGain(system, Q, R);
  const LinearizedPlant plant = RacerDynamics{}.linearized(Eigen::Vector4d::Zero(), 0);
  const Eigen::Vector4d exact =
      lqr({.A = plant.A, .B = plant.B}, Q, R * Eigen::Matrix<double, 1, 1>::Ones()).K.transpose();
  print("K", K.transpose());
  print("K of the library", exact.transpose());
  Rng rng(1);
  const Eigen::MatrixXd noise = kicks(500, kTau, kNoise, rng);
  Figure figure{
      .title = "LQR with noise, from a tilt of 0.2 rad", .xLabel = "time [s]", .yLabel = "[m], [rad]"};
  addMotion(figure, ", your gain", heldBy(K, .2, noise));
  addMotion(figure, ", the library's gain", heldBy(exact, .2, noise), true);
  plot("lqr", figure);
}

void showFeatures() {
  // Features of the gyroscope, by index.
  const std::vector<std::pair<int, std::string>> shown = {
      {3, "reading"}, {11, "its average, a = .5"}, {19, "its average, a = .9"}, {7, "its rate / 100"}};
  Figure figure{.title = "Features of a reading that jumps",
                .xLabel = "time [s]",
                .yLabel = "[rad/s], [rad/s^2] / 100"};
  for (const auto& [feature, label] : shown) figure.series.push_back({.label = label});
  Eigen::VectorXd latest;
  for (int t = 0; t < 50; ++t) {
    latest = featuresAt(Eigen::Vector4d(0, 0, t < 10 ? 0 : 1, 0), latest, 0, kTau);
    for (std::size_t i = 0; i < shown.size(); ++i)
      figure.series[i].add(kTau * t, latest[shown[i].first] / (i == 3 ? 100 : 1));
  }
  if (latest.isZero()) return nothingYet("features");
  plot("features", figure);
}

void showRides(const Eigen::VectorXd& w) {
  Rng rng(5);
  const Ride ride = rideOf(w, tilted(.2), kicks(2000, kTau, kNoise, rng), {}, {});
  if (ride.controls.size() == 0) return nothingYet("rides");
  std::printf("A ride of %.1f s costs %.3f.\n", kTau * static_cast<double>(ride.controls.size()), ride.cost);
  Figure figure{.title = "A ride with the four readings alone", .xLabel = "time [s]", .yLabel = "[m], [rad]"};
  addMotion(figure, "", ride.states);
  plot("rides", figure);
}

void showEvolution() {
  constexpr int kLambda = 20, kMu = 5, kGenerations = 120;
  const Species start{Eigen::VectorXd::Constant(6, 3), 1, Eigen::VectorXd::Zero(6)};
  Figure figure{.title = "Search for the lowest point of a bowl",
                .xLabel = "generation",
                .yLabel = "lowest cost of its samples",
                .logY = true};
  for (const auto& [name, steepest] : {std::pair{"a round bowl", 1.}, {"a long valley", 1e4}}) {
    Eigen::VectorXd steepness(6);
    for (int i = 0; i < 6; ++i) steepness[i] = std::pow(steepest, i / 5.);
    Series yours{.label = std::string("your strategy, ") + name},
        library{.label = std::string("CMA-ES, ") + name, .dashed = true};
    const auto recorded = [&](Series& series, const Eigen::MatrixXd& X) {
      const Eigen::VectorXd costs = X.cwiseAbs2().transpose() * steepness;
      series.add(static_cast<double>(series.x.size()), costs.minCoeff());
      return costs;
    };
    Rng rng(1);
    evolved([&](const Eigen::MatrixXd& X) { return recorded(yours, X); }, start, kMu, kLambda, kGenerations,
            rng);
    if (yours.x.empty()) return nothingYet("an evolution strategy");
    SearchCma cma(1);
    cma.init(start.mean, kMu, kLambda, start.deviation);
    Eigen::MatrixXd samples;
    Eigen::VectorXd costs;
    for (int i = 0; i < kGenerations; ++i) {
      cma.step(samples, costs);
      costs = recorded(library, samples.transpose());
    }
    figure.series.push_back(yours);
    figure.series.push_back(library);
  }
  plot("evolution", figure);
}

Eigen::VectorXd showSearch(const Eigen::VectorXd& direct) {
  Rng rng(7);
  const Lesson lesson = learnt(ridesOfYours(rng), 0);
  if (lesson.policy.isZero()) {
    nothingYet("a search");
    return lesson.policy;
  }
  print("rides of the search", static_cast<double>(lesson.costs.size()));
  print("weights of 1, y and its rates", lesson.policy.head(9).transpose());
  plot("drift", {.title = "Without an estimate of the wheel's speed, a racer sways more and more",
                 .xLabel = "time [s]",
                 .yLabel = "root mean square of x [m]",
                 .series = {driftOf("a policy on (1, y)", direct), driftOf("your policy", lesson.policy)}});
  plot("robust",
       {.title = "Rides that last 5 s",
        .xLabel = "strength of the noise",
        .yLabel = "share",
        .legend = Legend::kOutside,
        .series = {robustnessOf("a policy on (1, y)", direct), robustnessOf("your policy", lesson.policy),
                   robustnessOf("without control", Eigen::VectorXd::Zero(kFeatures))}});
  showFilm(lesson);
  if (lesson.costs.size() >= 1000)
    showLearning(lesson);
  else
    std::printf("No learning.png: it needs a search of 1000 rides.\n");
  return lesson.policy;
}

void showSensed(const Eigen::VectorXd& policy) {
  const RacerModel racer;
  Rng rng(7);
  const Eigen::MatrixXd noise = kicks(1000, kTau, kNoise, rng);
  const Ride byState = rideOf(policy, tilted(.2), noise, {}, {});
  const Eigen::MatrixXd Y = readingsOf(byState);
  if (Y.cols() == 0 || sensedCost(Y, 1000) == 0) return nothingYet("costs from sensors");
  Rng other(7);
  const Ride bySensors = rideOf(learnt(ridesOfYours(other, true), 0).policy, tilted(.2), noise, {}, {});
  std::printf("10 s of the policy by the state cost %.3f, and by the sensors %.3f.\n", byState.cost,
              bySensors.cost);
  Figure figure{.title = "Two policies: searched with costs of the state, and of the sensors",
                .xLabel = "time [s]",
                .yLabel = "[m], [rad]"};
  addMotion(figure, ", by the state", byState.states);
  addMotion(figure, ", by the sensors", bySensors.states, true);
  figure.series[2].color = Color{0, .45f, .7f};  // x is blue and theta orange, as above
  figure.series[3].color = Color{.84f, .37f, 0};
  Series sensed{.label = "x of your sensedPose", .color = Color{0, 0, 0}};
  for (Eigen::Index t = 0; t < Y.cols(); t += 20)
    sensed.add(kTau * static_cast<double>(t + 1), sensedPose(Y.col(t), racer, {})[0]);
  sensed.style = SeriesStyle::kPoints;
  figure.series.push_back(sensed);
  plot("sensed", figure);
}

#include "show.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "control/gain_search.h"
#include "control/regulators.h"
#include "course/cart_pole.h"
#include "course/cart_pole_pictures.h"

using namespace rex;

namespace {

constexpr PoleCart kCart;
constexpr double kTau = 1. / 60;

// A coordinate of the state over time.
Series overTime(const std::string& label, const Eigen::MatrixXd& states, int row) {
  Series series{.label = label};
  for (Eigen::Index t = 0; t < states.cols(); ++t) {
    series.x.push_back(kTau * static_cast<double>(t));
    series.y.push_back(states(row, t));
  }
  return series;
}

double forceOf(const Eigen::MatrixXd& K, const Eigen::Vector4d& x) {
  double u = 0;
  for (int i = 0; i < 4; ++i) u += K(0, i) * x[i];
  return u;
}

Eigen::MatrixXd withoutNoise(const Eigen::MatrixXd& K, const Eigen::Vector4d& start, double seconds) {
  Rng rng(0);
  return balanced(kCart, K, start, {.noise = 0, .steps = static_cast<int>(seconds / kTau)}, rng);
}

// The share of outings of 20 s that do not end in a fall.
double survivors(const Eigen::MatrixXd& K, double angle, double noise) {
  constexpr int kRuns = 60, kSteps = 1200;
  int count = 0;
  for (int run = 0; run < kRuns; ++run) {
    Rng rng(static_cast<std::uint64_t>(run));
    count += balanced(kCart, K, {0, 0, angle, 0}, {.noise = noise, .steps = kSteps}, rng).cols() > kSteps;
  }
  return static_cast<double>(count) / kRuns;
}

// The poles of x' = (A + B K) x.
Series polesOf(const std::string& label, const Plant& plant, const Eigen::MatrixXd& K, Marker marker) {
  Eigen::MatrixXd closed = plant.A;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) closed(i, k) += plant.B(i, 0) * K(0, k);
  Series series{.label = label, .style = SeriesStyle::kPoints, .marker = marker, .size = 1.6};
  for (const std::complex<double>& pole : eigenvalues(closed)) {
    series.x.push_back(pole.real());
    series.y.push_back(pole.imag());
  }
  return series;
}

// Along rays from rest: the first distance at which `ends` holds.
Series edgeOf(const std::string& label, const Color& color,
              const std::function<bool(double theta, double rate)>& ends) {
  Series series{.label = label, .color = color};
  for (int i = 0; i <= 120; ++i) {
    const double angle = 2 * std::numbers::pi * i / 120, c = std::cos(angle), s = 3 * std::sin(angle);
    double r = .03;
    while (r < 5 && std::abs(r * c) < 1.56 && !ends(r * c, r * s)) r += .03;
    series.x.push_back(r * c);
    series.y.push_back(r * s);
  }
  return series;
}

// The starts with p = p' = 0 for which x^T P x is at most the level.
CovarianceEllipse sectionOf(const Eigen::MatrixXd& P, double level) {
  const double a = P(2, 2), b = P(2, 3), c = P(3, 3), D = a * c - b * b;
  CovarianceEllipse section{.label = "proved", .sigmas = std::sqrt(level), .color = Color{.1, .4, .7}};
  section.covariance << c / D, -b / D, -b / D, a / D;
  return section;
}

}  // namespace

Plant plantOfTheLibrary() {
  const LinearizedPlant plant = CartPole().getLinearization();
  return {plant.A, plant.B};
}

Eigen::MatrixXd gainsOfTheLibrary(const Plant& plant, const Costs& costs) {
  return -lqr({.A = plant.A, .B = plant.B}, costs.Q, costs.R).K;
}

double slowestOfTheLibrary(const Plant& plant, const Eigen::MatrixXd& start) {
  return fastestGains({.A = plant.A, .B = plant.B}, -start, {.bound = start.maxCoeff()}).rate;
}

Eigen::MatrixXd differencesByState(const PoleCart& cart) {
  return numericJacobian([&](const Eigen::VectorXd& x) { return rateOf(cart, x, 0); },
                         Eigen::VectorXd::Zero(4));
}

void showOutings(const Eigen::MatrixXd& K) {
  Figure theta{.title = "The pole from several angles, without noise",
               .xLabel = "time [s]",
               .yLabel = "theta [rad]",
               .yRange = AxisRange{-1.6, 1.6}};
  Figure position{.title = "The cart", .xLabel = "time [s]", .yLabel = "p [m]"};
  Figure force{.title = "The force", .xLabel = "time [s]", .yLabel = "u [N]"};
  for (Figure* figure : {&theta, &position, &force}) figure->legend = Legend::kOutside;
  for (const double angle : {.2, .5, .8, 1., 1.1}) {
    const Eigen::MatrixXd states = withoutNoise(K, {0, 0, angle, 0}, 12);
    const std::string label = "from " + std::to_string(angle).substr(0, 3);
    theta.series.push_back(overTime(label, states, 2));
    position.series.push_back(overTime(label, states, 0));
    Series forces = overTime(label, states, 0);
    for (Eigen::Index t = 0; t < states.cols(); ++t)
      forces.y[static_cast<std::size_t>(t)] = forceOf(K, states.col(t));
    force.series.push_back(forces);
  }
  plot("theta", theta);
  plot("position", position);
  plot("force", force);
}

void showSurvival(const Eigen::MatrixXd& K, const Eigen::MatrixXd& printed) {
  Figure figure{.title = "Share of 60 outings of 20 s that do not end in a fall",
                .xLabel = "theta at the start [rad]",
                .yLabel = "share",
                .yRange = AxisRange{-.02, 1.05},
                .legend = Legend::kOutside};
  for (const double noise : {.1, .2, .3})
    for (const Eigen::MatrixXd* gains : {&K, &printed}) {
      const bool isPrinted = gains == &printed;
      const std::string level = "noise " + std::to_string(noise).substr(0, 3);
      Series series{.label = level + (isPrinted ? ", K of the sheet" : ", your K"), .dashed = isPrinted};
      series.color = noise < .15 ? Color{.1, .4, .7} : noise < .25 ? Color{.85, .5, .1} : Color{.7, .15, .2};
      for (double angle = 0; angle < 1.35; angle += .05) {
        series.x.push_back(angle);
        series.y.push_back(survivors(*gains, angle, noise));
      }
      figure.series.push_back(series);
    }
  plot("survival", figure);
}

void showBalance(const Eigen::MatrixXd& K) {
  Eigen::MatrixXd states = withoutNoise(K, {0, 0, .8, 0}, 8);
  CartPole pole(0, {.noise = 0});
  pole.x = Eigen::Vector4d(0, 0, .8, 0);
  double apart = 0;
  for (Eigen::Index t = 0; t < states.cols(); ++t) {
    apart = std::max(apart, (pole.x - states.col(t)).cwiseAbs().maxCoeff());
    pole.step(forceOf(K, pole.x));
  }
  print("seconds in your simulation, which should be 8", kTau * static_cast<double>(states.cols() - 1));
  print("largest distance from the library's, which should be 0", apart);
  Rng rng(2);
  states = balanced(kCart, K, {0, 0, .4, 0}, {.steps = 600}, rng);
  std::vector<CartPoleView> views;
  for (Eigen::Index t = 0; t < states.cols(); ++t) {
    const Eigen::Vector4d now = states.col(t);
    views.push_back({.x = now, .u = forceOf(K, now), .caption = "u = K x, noise 0.1"});
  }
  writeFilm(views, "balanced");
}

void showFates() {
  const auto fate = [](double stiffness, double damping) {
    Eigen::MatrixXd A(2, 2);
    A << 0, 1, -stiffness, -damping;
    return static_cast<double>(fateOf(A));
  };
  print("fates of a mass on a spring with a damper, on a spring, and alone: 0 dies, 1 stays, 2 grows",
        Eigen::RowVector3d(fate(1, 1), fate(1, 0), fate(0, 0)));
}

void showPoles(const Plant& real, const Eigen::MatrixXd& K, const Eigen::MatrixXd& printed,
               const Eigen::MatrixXd& quick) {
  Figure figure{.title = "Poles of the cart pole",
                .xLabel = "real part [1/s]",
                .yLabel = "imaginary part [1/s]",
                .xRange = AxisRange{-6, 4},
                .yRange = AxisRange{-4, 4},
                .legend = Legend::kOutside};
  figure.regions = {{.label = "stable", .x = {-6, 0, 0, -6}, .y = {-4, -4, 4, 4}}};
  figure.series = {polesOf("without control", real, Eigen::MatrixXd::Zero(1, 4), Marker::kCross),
                   polesOf("your K", real, K, Marker::kCircle),
                   polesOf("K of the sheet", real, printed, Marker::kPlus),
                   polesOf("your quick K", real, quick, Marker::kSquare)};
  plot("poles", figure);
}

void showQuick(const Eigen::MatrixXd& K, const Eigen::MatrixXd& quick) {
  Figure figure{.title = "Optimal gains and quick ones, from theta = 0.2",
                .xLabel = "time [s]",
                .yLabel = "theta [rad], p [m]"};
  for (const Eigen::MatrixXd* gains : {&K, &quick}) {
    const Eigen::MatrixXd states = withoutNoise(*gains, {0, 0, .2, 0}, 10);
    for (const int row : {0, 2}) {
      Series series = overTime(row == 0 ? "p" : "theta", states, row);
      series.label += gains == &K ? ", optimal" : ", quick";
      series.dashed = row == 0;
      series.color = gains == &K ? Color{.1, .4, .7} : Color{.85, .4, .1};
      figure.series.push_back(series);
    }
  }
  plot("quick", figure);
}

void showRegion(const Plant& real) {
  const Costs costs{Eigen::Vector4d(1, 1, 100, 100).asDiagonal(), Eigen::MatrixXd::Identity(1, 1)};
  const Eigen::MatrixXd P = viaHamiltonian(real, costs), K = gainOf(real, costs, P);
  const Flow f = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return rateOf(kCart, x, forceOf(K, x)); };
  const auto falls = [&](double theta, double rate) {
    return withoutNoise(K, {0, 0, theta, rate}, 10).cols() < 600;
  };
  const auto rises = [&](double theta, double rate) {
    const Eigen::VectorXd moves = f(Eigen::Vector4d(0, 0, theta, rate));
    double slope = 0;
    for (int i = 0; i < 4; ++i) slope += (theta * P(2, i) + rate * P(3, i)) * moves[i];
    return slope >= 0;
  };
  Figure figure{.title = "Starts with p = p' = 0",
                .xLabel = "theta [rad]",
                .yLabel = "theta' [rad/s]",
                .yRange = AxisRange{-9, 9},
                .legend = Legend::kOutside};
  figure.series = {edgeOf("falls from here on", {.7, .15, .2}, falls),
                   edgeOf("V rises from here on", {.85, .5, .1}, rises)};
  if (P.isZero()) return plot("region", figure);

  Eigen::VectorXd high = Eigen::Vector4d(8, 6, 1.5, 3);
  Rng rng(1);
  for (int i = 0; i < 40 && counterexample(f, P, high, rng); ++i) high *= .9;
  const double level = levelInside(P, high);
  print("box in which V falls", high.transpose());
  print("level in that box", level);
  if (level > 0) figure.ellipses = {sectionOf(P, level)};
  plot("region", figure);
}

void showHorizon(const Plant& real, const Costs& costs, const Eigen::MatrixXd& optimal) {
  constexpr int kSteps = 480;
  // In discrete time, by Euler steps.
  Plant steps{kTau * real.A, kTau * real.B};
  for (int i = 0; i < 4; ++i) steps.A(i, i) += 1;
  const std::vector<Eigen::MatrixXd> K =
      gainsOverTime(steps, {kTau * costs.Q, kTau * costs.R}, Eigen::MatrixXd::Zero(4, 4), kSteps);
  Figure figure{.title = "Gains of a horizon of 8 s (dashed: continuous time, infinite horizon)",
                .xLabel = "time [s]",
                .yLabel = "gain",
                .legend = Legend::kOutside};
  const char* names[] = {"p", "p'", "theta", "theta'"};
  const Color colors[] = {{.1, .4, .7}, {.85, .5, .1}, {.15, .55, .3}, {.7, .15, .2}};
  for (int i = 0; i < 4; ++i) {
    Series series{.label = std::string("of ") + names[i], .color = colors[i]};
    for (int t = 0; t < kSteps; ++t) {
      series.x.push_back(kTau * t);
      series.y.push_back(K[static_cast<std::size_t>(t)](0, i));
    }
    figure.series.push_back(series);
    figure.series.push_back(
        {.x = {0, 8}, .y = {optimal(0, i), optimal(0, i)}, .dashed = true, .color = colors[i]});
  }
  plot("horizon", figure);
}

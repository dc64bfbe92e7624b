#include "show.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "control/gain_search.h"
#include "control/regulators.h"
#include "control/responses.h"
#include "course/cart_pole_pictures.h"
#include "render/figure_builders.h"
#include "systems/cart_pole.h"

using namespace rex;

namespace {

constexpr PoleCart kCart;
constexpr double kTau = 1. / 60;

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
  for (const std::complex<double>& pole : eigenvalues(closed)) series.add(pole.real(), pole.imag());
  return series;
}

const Color kLoopColors[] = {{.1, .4, .7}, {.15, .55, .3}, {.85, .4, .1}};

// The loop cut open at u, from u to -u: its critical point is -1.
struct OpenLoop {
  std::string label;
  Plant plant;
  Eigen::MatrixXd minusK;
};

std::vector<OpenLoop> openLoops(const Plant& real, const Eigen::MatrixXd& K,
                                const std::vector<Sensor>& sensors) {
  std::vector<OpenLoop> loops{{"x is known", real, -K}};
  for (const Sensor& sensor : sensors) {
    // The plant does not hear the controller, but the test signal.
    OpenLoop loop{sensor.label, {}, Eigen::MatrixXd::Zero(1, 8)};
    loop.plant = {observedLoop({real.A, 0 * real.B}, real, sensor.C, K, sensor.L),
                  Eigen::MatrixXd::Zero(8, 1)};
    loop.plant.B.topRows(4) = real.B;
    loop.minusK.rightCols(4) = -K;
    loops.push_back(loop);
  }
  return loops;
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
    theta.series.push_back(overTime(states.row(2), kTau, {.label = label}));
    position.series.push_back(overTime(states.row(0), kTau, {.label = label}));
    std::vector<double> forces;
    for (const auto& x : states.colwise()) forces.push_back(forceOf(K, x));
    force.series.push_back(overTime(forces, kTau, {.label = label}));
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
      for (double angle = 0; angle < 1.35; angle += .05) series.add(angle, survivors(*gains, angle, noise));
      figure.series.push_back(series);
    }
  plot("survival", figure);
}

void showBalance(const Eigen::MatrixXd& K) {
  Rng rng(2);
  const Eigen::MatrixXd states = withoutNoise(K, {0, 0, .8, 0}, 8),
                        noisy = balanced(kCart, K, {0, 0, .4, 0}, {.steps = 600}, rng);
  if (!K.allFinite() || !states.allFinite() || !noisy.allFinite() || states.size() * noisy.size() == 0)
    return nothingYet("your simulation: K or a state is not finite, or there are no states");
  CartPole pole(0, {.noise = 0});
  pole.x = Eigen::Vector4d(0, 0, .8, 0);
  double apart = 0;
  for (Eigen::Index t = 0; t < states.cols(); ++t) {
    apart = std::max(apart, (pole.x - states.col(t)).cwiseAbs().maxCoeff());
    pole.step(forceOf(K, pole.x));
  }
  print("seconds in your simulation (wanted: 8)", kTau * static_cast<double>(states.cols() - 1));
  print("largest distance from the library's (wanted: 0)", apart);
  std::vector<CartPoleView> views;
  for (Eigen::Index t = 0; t < noisy.cols(); ++t) {
    const Eigen::Vector4d now = noisy.col(t);
    views.push_back({.x = now, .u = forceOf(K, now), .caption = "u = K x, noise 0.1"});
  }
  writeFilm(cartPoleFilm(views), "balanced");
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
  figure.series = {polesOf("your K", real, K, Marker::kCircle),
                   polesOf("your quick K", real, quick, Marker::kSquare),
                   polesOf("K of the sheet", real, printed, Marker::kPlus),
                   polesOf("without control", real, Eigen::MatrixXd::Zero(1, 4), Marker::kCross)};
  for (const Series& one : figure.series)
    for (std::size_t i = 0; i < one.x.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (std::hypot(one.x[i] - one.x[k], one.y[i] - one.y[k]) < .02)
          figure.notes.push_back({"twice", one.x[i] + .15, one.y[i] - .3});
  plot("poles", figure);
}

void showQuick(const Eigen::MatrixXd& K, const Eigen::MatrixXd& quick) {
  Figure figure{.title = "Optimal gains and quick ones, from theta = 0.2",
                .xLabel = "time [s]",
                .yLabel = "theta [rad], p [m]"};
  for (const Eigen::MatrixXd* gains : {&K, &quick}) {
    const Eigen::MatrixXd states = withoutNoise(*gains, {0, 0, .2, 0}, 10);
    for (const int row : {0, 2})
      figure.series.push_back(
          overTime(states.row(row), kTau,
                   {.label = (row == 0 ? "p" : "theta") + std::string(gains == &K ? ", optimal" : ", quick"),
                    .dashed = row == 0,
                    .color = gains == &K ? Color{.1, .4, .7} : Color{.85, .4, .1}}));
  }
  plot("quick", figure);
}

Noise noiseOfSteps(double ofRates, double ofSensors, int sensors) {
  // In a step, white noise of intensity W adds noise of covariance W tau to x, and the mean of v has
  // covariance V / tau.
  const double w = ofRates * ofRates / kTau;
  return {Eigen::Vector4d(0, w, 0, w).asDiagonal(),
          ofSensors * ofSensors * kTau * Eigen::MatrixXd::Identity(sensors, sensors)};
}

Eigen::MatrixXd observerGainOfTheLibrary(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C,
                                         const Noise& noise) {
  return steadyKalman({.A = A, .B = Eigen::MatrixXd::Zero(A.rows(), 1), .C = C}, noise.W, noise.V).L;
}

void showSeen(const Eigen::MatrixXd& K, const Sensor& sensor) {
  const Plant real = plantOfTheLibrary();
  const Eigen::MatrixXd loop = observedLoop(real, real, sensor.C, K, sensor.L);
  print("slowest pole of x and x^, which should be -0.506 [1/s]", eigenvalues(loop).real().maxCoeff());
  const Eigen::MatrixXd observer = loop.bottomRightCorner(4, 4);
  constexpr int kSteps = 1200;
  Eigen::MatrixXd states = Eigen::MatrixXd::Zero(4, kSteps), estimates = states;
  states(2, 0) = .1;
  Rng rng(3);
  int t = 0;
  for (; t + 1 < kSteps && std::abs(states(2, t)) < std::numbers::pi / 2; ++t) {
    const Eigen::Vector4d x = states.col(t), believed = estimates.col(t), moves = observer * believed;
    const double y = sensor.C.row(0).dot(x) + .002 * rng.normal();
    states.col(t + 1) = stepped(kCart, x, forceOf(K, believed), kTau, .005, rng);
    estimates.col(t + 1) = believed + kTau * (moves + y * sensor.L.col(0));
  }
  Figure figure{.title = "The cart pole and its observer: " + sensor.label,
                .xLabel = "time [s]",
                .yLabel = "p [m], theta [rad]",
                .legend = Legend::kOutside};
  for (const int row : {0, 2}) {
    const std::string name = row == 0 ? "p" : "theta";
    figure.series.push_back(
        overTime(states.row(row).head(t), kTau, {.label = name, .color = kLoopColors[row]}));
    figure.series.push_back(
        overTime(estimates.row(row).head(t), kTau,
                 {.label = name + ", estimated", .dashed = true, .color = Color{.1, .1, .1}}));
  }
  plot("seen", figure);
}

void showLoops(const Plant& real, const Eigen::MatrixXd& K, const std::vector<Sensor>& sensors) {
  const std::vector<double> frequencies = frequenciesBetween(.1, 100, 600);
  Figure bode, nyquist;
  for (const OpenLoop& loop : openLoops(real, K, sensors)) {
    const Eigen::MatrixXd G =
        responseAt(loop.plant, loop.minusK, Eigen::Map<const Eigen::VectorXd>(frequencies.data(), 600));
    std::vector<std::complex<double>> values;
    std::vector<double> decibels;
    for (const auto& column : G.colwise()) {
      values.emplace_back(column[0], column[1]);
      decibels.push_back(20 * std::log10(std::max(1e-6, std::abs(values.back()))));
    }
    Figure magnitudes = bodeMagnitudeFigure(frequencies, decibels), curves = nyquistFigure(values);
    const Color color = kLoopColors[bode.series.size()];
    for (Series* series : {&magnitudes.series[0], &curves.series[0], &curves.series[1]})
      series->color = color;
    magnitudes.series[0].label = curves.series[0].label = loop.label;
    curves.series[1].label = "";
    if (bode.series.empty()) {
      bode = magnitudes, nyquist = curves;
    } else {
      bode.series.push_back(magnitudes.series[0]);
      nyquist.series.insert(nyquist.series.end() - 1, {curves.series[0], curves.series[1]});
    }
  }
  bode.title = nyquist.title = "The loop, cut open at u";
  bode.legend = Legend::kOutside;
  nyquist.title += " (dashed: w < 0)";
  Series circle{.label = "distance 1 from -1", .dashed = true, .color = Color{.6, .6, .6}};
  for (int i = 0; i <= 90; ++i) {
    const double angle = 2 * std::numbers::pi * i / 90;
    circle.add(-1 + std::cos(angle), std::sin(angle));
  }
  nyquist.series.push_back(circle);
  plot("bode", bode);
  plot("nyquist", nyquist);
}

void showMargins(const Plant& real, const Eigen::MatrixXd& K, const std::vector<Sensor>& sensors) {
  Figure figure{.title = "The slowest pole if the force is too weak or too strong",
                .xLabel = "factor of the force",
                .yLabel = "real part [1/s]",
                .logX = true,
                .yRange = AxisRange{-1, 2},
                .legend = Legend::kOutside};
  figure.horizontalLines = {{.at = 0}};
  figure.verticalLines = {{.at = 1}};
  Series known{.label = "x is known", .color = kLoopColors[0]};
  for (const double factor : frequenciesBetween(.1, 10, 400))
    known.add(factor, slowestPole({real.A, factor * real.B}, K));
  figure.series = {known};
  for (const Sensor& sensor : sensors) {
    Series series{.label = sensor.label, .x = known.x, .color = kLoopColors[figure.series.size()]};
    for (const double factor : known.x)
      series.y.push_back(eigenvalues(observedLoop({real.A, factor * real.B}, real, sensor.C, K, sensor.L))
                             .real()
                             .maxCoeff());
    figure.series.push_back(series);
  }
  plot("margins", figure);
}

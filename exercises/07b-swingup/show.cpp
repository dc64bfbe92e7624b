#include "show.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "control/ilqr.h"
#include "control/regulators.h"
#include "control/value_grid.h"
#include "course/film.h"

using namespace rex;

namespace {

constexpr double kPi = std::numbers::pi;
const Color kColors[] = {{.1f, .4f, .7f}, {.85f, .4f, .1f}, {.15f, .55f, .3f}};

double torqueOf(const Pendulum& pendulum, const Eigen::RowVector2d& K, const Eigen::Vector2d& x) {
  return std::clamp(K[0] * x[0] + K[1] * x[1], -pendulum.strongest, pendulum.strongest);
}

// Along rays: the first place at which `ends` holds.
Series edgeOf(const std::string& label, const Color& color,
              const std::function<bool(const Eigen::Vector2d& x)>& ends) {
  Series series{.label = label, .color = color};
  for (int i = 0; i <= 360; ++i) {
    const Eigen::Vector2d ray(std::cos(i * kPi / 180), 4 * std::sin(i * kPi / 180));
    double r = .01;
    while (r < 4 && !ends(r * ray)) r += .01;
    series.add(r * ray[0], r * ray[1]);
  }
  return series;
}

void addPendulum(Picture& picture, double place, double angle, double length, const Motion& motion,
                 const Color& color) {
  const Pose X_WP = translation(place, 0, 1.4) * rotation(angle, Eigen::Vector3d::UnitY());
  picture.solids.push_back(
      {{.extent = {.06, .06, length}}, X_WP * translation(0, 0, length / 2), {.5f, .5f, .5f}, "rod"});
  picture.solids.push_back(
      {{.type = ShapeType::kSphere, .radius = .13}, X_WP * translation(0, 0, length), color, "mass"});
  picture.labels.push_back({.text = motion.label, .p_WQ = {place - .5, 0, .05}, .scale = 1.3});
}

}  // namespace

double costByTheLibrary(const Decision& decision, const Eigen::Vector2d& x) {
  const Pendulum p = decision.pendulum;
  const ValueGrid values(
      {.rate = [=](const Eigen::Vector2d& at, double u) { return rateOf(p, at, u); },
       .cost = [=](const Eigen::Vector2d& at, double u) { return costOf(at, u, decision.effort); },
       .uMin = -p.strongest,
       .uMax = p.strongest,
       .discount = -std::log(decision.discount) / decision.tau},
      {.lower = {-kPi, -decision.grid.fastest},
       .upper = {kPi, decision.grid.fastest},
       .nodes = {decision.grid.angles + 1, decision.grid.rates},
       .isAngle = {1, 0},
       .controls = decision.torques,
       .step = decision.tau,
       .tolerance = 1e-4});
  return values.value(x);
}

double priceByTheLibrary(const Journey& journey, const Eigen::VectorXd& U) {
  const auto residual = [](const Eigen::VectorXd& x, double u, double weight, double effort) {
    return Eigen::VectorXd(std::sqrt(weight) * Eigen::Vector3d(2 * std::sin(x[0] / 2), std::sqrt(.05) * x[1],
                                                               std::sqrt(effort) * u));
  };
  const ControlProblem problem{
      .next = [&](const Eigen::VectorXd& x, const Eigen::VectorXd& u) -> Eigen::VectorXd {
        return nextOf(journey.pendulum, x, u[0], journey.tau);
      },
      .stage = [&](const Eigen::VectorXd& x, const Eigen::VectorXd& u,
                   int) { return residual(x, u[0], journey.tau, journey.effort); },
      .final = [&](const Eigen::VectorXd& x) { return residual(x, 0, journey.last, 0); },
      .start = journey.start};
  return ilqr(problem, U.transpose()).cost;
}

Swing regulatorOfTheLibrary(const Pendulum& pendulum) {
  const double inertia = pendulum.mass * pendulum.length * pendulum.length;
  const Eigen::Matrix2d A{{0, 1}, {pendulum.g / pendulum.length, -pendulum.friction / inertia}};
  const RiccatiResult best =
      lqr({.A = A, .B = Eigen::Vector2d(0, 1 / inertia)}, Eigen::Vector2d(10, 1).asDiagonal().toDenseMatrix(),
          Eigen::MatrixXd::Identity(1, 1));
  return {.K = -best.K.row(0), .P = best.X};
}

Flow flowOf(const Pendulum& pendulum, const Eigen::RowVector2d& K) {
  return [=](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return rateOf(pendulum, x, torqueOf(pendulum, K, x));
  };
}

void showValues(const Grid& grid, const Eigen::MatrixXd& V, const Motion& motion) {
  Figure figure{.title = "What it costs to get up, and the motion that costs least",
                .xLabel = "theta [rad]",
                .yLabel = "theta' [rad/s]",
                .colorLabel = "V [1]"};
  // The first angle once more at the other end; each node is the middle of a cell.
  const double cell = kPi / grid.angles, high = grid.fastest * (1 + 1. / (grid.rates - 1));
  figure.heatMap =
      HeatMap{.xRange = {-kPi - cell, kPi - cell}, .yRange = {-high, high}, .values = V.transpose()};
  Series way{
      .label = motion.label, .style = SeriesStyle::kPoints, .marker = Marker::kDot, .color = Color{1, 1, 1}};
  for (const auto& x : motion.X.colwise()) way.add(std::remainder(x[0], 2 * kPi), x[1]);
  figure.series.push_back(way);
  plot("values", figure);
}

void showGains(const Pendulum& pendulum) {
  constexpr double kTau = .01;
  const Plant step = stepNear(pendulum, {0, 0}, 0, kTau);
  const std::vector<Eigen::MatrixXd> K = gainsOverTime(
      step,
      {kTau * Eigen::Vector2d(10, 1).asDiagonal().toDenseMatrix(), kTau * Eigen::MatrixXd::Identity(1, 1)},
      Eigen::MatrixXd::Zero(2, 2), 300);
  const Swing library = regulatorOfTheLibrary(pendulum);
  Figure figure{.title = "Gains of a horizon of 3 s upright (dashed: continuous time, without end)",
                .xLabel = "time [s]",
                .yLabel = "gain",
                .legend = Legend::kOutside};
  for (const int i : {0, 1}) {
    Series series{.label = i == 0 ? "of theta" : "of theta'", .color = kColors[i]};
    for (std::size_t t = 0; t < K.size(); ++t) series.add(kTau * static_cast<double>(t), K[t](0, i));
    figure.series.push_back(series);
    figure.series.push_back(
        {.x = {0, 3}, .y = {library.K[i], library.K[i]}, .dashed = true, .color = kColors[i]});
  }
  plot("gains", figure);
}

void showRegion(const Pendulum& pendulum, const Swing& swing) {
  const Flow f = flowOf(pendulum, swing.K);
  const auto rises = [&](const Eigen::Vector2d& x) {
    const Eigen::VectorXd rate = f(x);
    return x[0] * (swing.P(0, 0) * rate[0] + swing.P(0, 1) * rate[1]) +
               x[1] * (swing.P(1, 0) * rate[0] + swing.P(1, 1) * rate[1]) >=
           0;
  };
  const auto isLost = [&](Eigen::Vector2d x) {
    for (int t = 0; t < 600 && std::abs(x[0]) < kPi; ++t)
      x = nextOf(pendulum, x, torqueOf(pendulum, swing.K, x), .01);
    return x.norm() > .1;
  };
  Figure figure{.title = "Where u = K x catches, with at most 3 N m",
                .xLabel = "theta [rad]",
                .yLabel = "theta' [rad/s]",
                .xRange = AxisRange{-1.8, 1.8},
                .yRange = AxisRange{-6, 6},
                .legend = Legend::kOutside};
  figure.series = {edgeOf("lost from here on", {.7f, .15f, .2f}, isLost),
                   edgeOf("V rises from here on", {.85f, .5f, .1f}, rises)};
  const Eigen::Matrix2d& P = swing.P;
  if (swing.level > 0) {
    const double D = P(0, 0) * P(1, 1) - P(0, 1) * P(0, 1);
    CovarianceEllipse proved{
        .label = "proved", .sigmas = std::sqrt(swing.level), .color = Color{.1f, .4f, .7f}};
    proved.covariance << P(1, 1) / D, -P(0, 1) / D, -P(0, 1) / D, P(0, 0) / D;
    figure.ellipses = {proved};
  }
  plot("region", figure);
}

void showMotions(const Pendulum& pendulum, const std::vector<Motion>& motions) {
  Figure angles{.title = "Three ways up", .xLabel = "time [s]", .yLabel = "theta [rad]"};
  Figure energies{.title = "The energy of each", .xLabel = "time [s]", .yLabel = "E [J]"};
  angles.legend = energies.legend = Legend::kOutside;
  Film film;
  constexpr double kSeconds = 8, kFrame = 1. / kFilmRate;
  for (double time = 0; time < kSeconds; time += kFrame)
    film.push_back({.time = time, .picture = {.ground = {.visible = false}}});
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const Motion& motion = motions[k];
    if (motion.X.cols() < 2) continue;
    Series angle{.label = motion.label, .color = kColors[k % 3]}, energy = angle;
    for (Eigen::Index t = 0; t < motion.X.cols(); ++t) {
      const double time = motion.tau * static_cast<double>(t);
      angle.add(time, motion.X(0, t));
      energy.add(time, energyOf(pendulum, motion.X.col(t)));
    }
    angles.series.push_back(angle);
    energies.series.push_back(energy);
    for (Frame& frame : film) {
      const auto t = std::min(static_cast<Eigen::Index>(frame.time / motion.tau), motion.X.cols() - 1);
      addPendulum(frame.picture, 2.6 * (static_cast<double>(k) - 1), motion.X(0, t), pendulum.length, motion,
                  kColors[k % 3]);
    }
  }
  if (angles.series.empty()) return;
  plot("angles", angles);
  plot("energies", energies);
  writeFilm(film, "swings", {.camera = framing(film, {0, -1, .1}, 2.2), .width = 660, .height = 300});
}

#include "gallery/figures.h"

#include <cmath>
#include <complex>
#include <numbers>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "base/rng.h"
#include "control/value_grid.h"
#include "formats/ors_reader.h"
#include "kinematics/forward_kinematics.h"
#include "kinematics/inverse_kinematics.h"
#include "kinematics/jacobians.h"
#include "optim/bayesian_search.h"
#include "render/figure_builders.h"
#include "support/paths.h"

namespace rex {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kPi = std::numbers::pi;

void append(Series& series, const Vector2d& p) {
  series.x.push_back(p.x());
  series.y.push_back(p.y());
}

void append(Series& series, const Vector3d& p) {
  append(series, Vector2d(p.head<2>()));
  series.z.push_back(p.z());
}

// A mass on a spring, pushed at 1 s, under three dampings.
Figure stepResponses() {
  Figure figure{.title = "Step response of a damped oscillator",
                .xLabel = "time [s]",
                .yLabel = "position [m]",
                .verticalLines = {{.at = 1}},
                .horizontalLines = {{.at = 1}},
                .notes = {{.text = "the step", .x = 1.05, .y = 0.08}, {.text = "set point", .x = 0, .y = 1}}};
  const double dt = 0.01, stiffness = 16;
  for (const double ratio : {0.2, 0.6, 1.0}) {
    Series& series = figure.series.emplace_back(Series{.label = fmt::format("damping ratio {}", ratio)});
    double position = 0, velocity = 0;
    for (int i = 0; i <= 600; ++i) {
      append(series, Vector2d(i * dt, position));
      const double target = i * dt < 1 ? 0 : 1;
      velocity += dt * (stiffness * (target - position) - 2 * ratio * std::sqrt(stiffness) * velocity);
      position += dt * velocity;
    }
  }
  return figure;
}

// 200 runs of the same tracking controller under noise.
Figure trackingError() {
  Figure figure{.title = "Tracking error of 200 runs",
                .xLabel = "time [s]",
                .yLabel = "error [mm]",
                .series = {{.label = "mean"}, {.label = "one run", .size = 0.6}},
                .horizontalLines = {{.at = 0}},
                .bands = {{.label = "one standard deviation"}}};
  Rng rng(4);
  const int steps = 250, runs = 200;
  MatrixXd errors(steps, runs);
  for (int run = 0; run < runs; ++run) {
    Vector2d state(30, 0);  // error in mm and its rate
    for (int i = 0; i < steps; ++i) {
      errors(i, run) = state.x();
      const double push = -20 * state.x() - 5 * state.y() + 60 * std::sqrt(1 + 0.02 * i) * rng.normal();
      state += 0.02 * Vector2d(state.y(), push);
    }
  }
  for (int i = 0; i < steps; ++i) {
    const double mean = errors.row(i).mean();
    const double deviation = std::sqrt((errors.row(i).array() - mean).square().mean());
    append(figure.series[0], Vector2d(0.02 * i, mean));
    append(figure.series[1], Vector2d(0.02 * i, errors(i, 0)));
    figure.bands[0].x.push_back(0.02 * i);
    figure.bands[0].low.push_back(mean - deviation);
    figure.bands[0].high.push_back(mean + deviation);
  }
  return figure;
}

// Particles after one measurement of the distance to a beacon, before they are drawn anew.
Figure particles() {
  Figure figure{.title = "Particles after measuring the distance to the beacon",
                .xLabel = "x [m]",
                .yLabel = "y [m]",
                .colorLabel = "weight, times the number of particles [1]",
                .equalAxes = true,
                .series = {{.style = SeriesStyle::kPoints, .size = 0.8},
                           {.x = {0}, .y = {0}, .marker = Marker::kTriangle, .size = 2.5, .color = Color{}}},
                .notes = {{.text = "beacon", .x = 0, .y = 0}},
                .width = 720,
                .height = 480};
  Rng rng(2);
  const int count = 1500;
  double total = 0;
  for (int i = 0; i < count; ++i) {
    const Vector2d p(2.4 + 0.9 * rng.normal(), 1.5 + 0.7 * rng.normal());
    append(figure.series[0], p);
    const double miss = (p.norm() - 2.6) / 0.25;
    figure.series[0].values.push_back(std::exp(-miss * miss / 2));
    total += figure.series[0].values.back();
  }
  for (double& weight : figure.series[0].values) weight *= count / total;
  return figure;
}

Figure samplesOfAMixture() {
  Rng rng(8);
  std::vector<double> samples;
  for (int i = 0; i < 3000; ++i)
    samples.push_back(rng.uniform() < 0.35 ? -1.2 + 0.5 * rng.normal() : 1 + 0.8 * rng.normal());
  const auto normal = [](double x, double mean, double deviation) {
    const double miss = (x - mean) / deviation;
    return std::exp(-miss * miss / 2) / (deviation * std::sqrt(2 * kPi));
  };
  Figure figure{.title = "3000 samples of a mixture of two normal distributions",
                .xLabel = "x [m]",
                .yLabel = "density [1/m]",
                .series = {{.label = "density", .color = Color{0.84f, 0.37f, 0}}},
                .histograms = {normalized(sampleHistogram(samples, 40))}};
  figure.histograms[0].label = "samples";
  for (double x = -4; x <= 4; x += 0.02)
    append(figure.series[0], Vector2d(x, 0.35 * normal(x, -1.2, 0.5) + 0.65 * normal(x, 1, 0.8)));
  return figure;
}

// A robot in a corridor of 20 cells sees doors at 2, 5 and 14, and goes right. Slides on the Bayes filter.
Figure beliefInACorridor() {
  const int cells = 20;
  VectorXd belief = VectorXd::Constant(cells, 1. / cells);
  const auto isDoor = [](int cell) { return cell == 2 || cell == 5 || cell == 14; };
  for (const bool seesDoor : {true, false, false, true}) {
    VectorXd moved(cells);
    for (int i = 0; i < cells; ++i) moved[i] = 0.15 * belief[i] + 0.85 * belief[(i + cells - 1) % cells];
    for (int i = 0; i < cells; ++i) moved[i] *= seesDoor == isDoor(i) ? 0.8 : 0.15;
    belief = moved / moved.sum();
  }
  return {.title = "Where is the robot? Door, wall, wall, door",
          .xLabel = "cell of the corridor",
          .yLabel = "probability [1]",
          .histograms = {{.label = "belief", .heights = {belief.begin(), belief.end()}}}};
}

// Rosenbrock's valley: Gauss-Newton runs along it, gradient descent creeps along the ground.
Figure costAndPaths() {
  const auto residual = [](const Vector2d& p) {
    return Vector2d(1 - p.x(), std::sqrt(20.) * (p.y() - p.x() * p.x()));
  };
  const auto jacobian = [](const Vector2d& p) {
    Matrix2d J;
    J << -1, 0, -2 * std::sqrt(20.) * p.x(), std::sqrt(20.);
    return J;
  };
  Figure figure{.title = "Two descents into Rosenbrock's valley",
                .xLabel = "x [1]",
                .yLabel = "y [1]",
                .colorLabel = "cost [1]",
                .logColor = true,
                .colorRange = AxisRange{0.01, 300},
                .legend = Legend::kOutside,
                .series = {{.label = "gradient descent, 400 steps", .size = 1.5},
                           {.label = "damped Gauss-Newton, 15 steps", .style = SeriesStyle::kLinesPoints},
                           {.x = {1}, .y = {1}, .marker = Marker::kPlus, .size = 2.5, .color = Color{}}},
                .heatMap = sampledHeatMap(
                    [&](double x, double y) {
                      return 1e-3 + residual({x, y}).squaredNorm();
                    },
                    {-2, 2}, {-1, 3}, 200, 200),
                .notes = {{.text = "minimum", .x = 1, .y = 1}},
                .width = 720,
                .height = 560};
  figure.heatMap->contours = 9;
  figure.series[0].color = Color{0.1f, 0.1f, 0.1f};
  figure.series[1].color = Color{0.95f, 0.35f, 0.1f};
  for (const bool newton : {false, true}) {
    Vector2d p(-1.6, 2.4);
    for (int i = 0; i < (newton ? 15 : 400); ++i) {
      append(figure.series[newton ? 1 : 0], p);
      const Vector2d gradient = jacobian(p).transpose() * residual(p);
      Vector2d step = -gradient;
      if (newton)
        step = -(jacobian(p).transpose() * jacobian(p) + 0.5 * Matrix2d::Identity()).inverse() * gradient;
      double length = newton ? 1 : 0.003;
      while (residual(p + length * step).squaredNorm() > residual(p).squaredNorm()) length /= 2;
      p += length * step;
    }
  }
  return figure;
}

Figure pendulum() {
  const double damping = 0.5;
  const auto field = [&](const Vector2d& s) {
    return Vector2d(s.y(), -9.81 * std::sin(s.x()) - damping * s.y());
  };
  Figure figure{
      .title = "Phase portrait of a damped pendulum",
      .xLabel = "angle [rad]",
      .yLabel = "angular velocity [rad/s]",
      .xRange = AxisRange{-5, 8},
      .yRange = AxisRange{-9, 9},
      .legend = Legend::kNone,
      .series = {},
      .arrows = {arrowField(field, {-5, 8}, {-9, 9}, 26, 18)},
      .notes = {{.text = "hangs", .x = 0.2, .y = 0.9}, {.text = "upright", .x = kPi + 0.2, .y = 0.9}},
      .height = 540};
  for (const Vector2d& start : {Vector2d(-4.9, 6.5), Vector2d(-4.9, 8.5), Vector2d(7.9, -7)}) {
    Series series;
    Vector2d s = start;
    for (int i = 0; i < 4000; ++i) {
      append(series, s);
      const Vector2d middle = s + 0.0025 * field(s);
      s += 0.005 * field(middle);
    }
    figure.series.push_back(series);
  }
  figure.series.push_back({.x = {0, kPi, 2 * kPi, -kPi},
                           .y = {0, 0, 0, 0},
                           .style = SeriesStyle::kPoints,
                           .marker = Marker::kDot,
                           .size = 2,
                           .color = Color{}});
  return figure;
}

// A rod of 1 kg and 1 m whose motor is too weak to lift it at once.
Figure valueOfAPendulum() {
  const PlanarControlProblem problem{
      .rate = [](const Vector2d& x,
                 double u) { return Vector2d(x[1], 9.81 * std::sin(x[0]) - 0.1 * x[1] + u); },
      .cost = [](const Vector2d& x,
                 double u) { return 2 * (1 - std::cos(x[0])) + 0.05 * x[1] * x[1] + 0.02 * u * u; },
      .uMin = -3,
      .uMax = 3,
      .discount = 0.1};
  const ValueGrid grid(
      problem,
      {.lower = {-kPi, -9}, .upper = {kPi, 9}, .nodes = {201, 201}, .isAngle = {1, 0}, .controls = 13});
  Figure figure{.title = "Cost of swinging up a pendulum from each state",
                .xLabel = "angle from upright [rad]",
                .yLabel = "angular velocity [rad/s]",
                .colorLabel = "cost [1]",
                .legend = Legend::kNone,
                .series = {},
                .heatMap = sampledHeatMap(
                    [&](double x, double y) {
                      return grid.value({x, y});
                    },
                    {-kPi, kPi}, {-9, 9}, 200, 200),
                .notes = {{.text = "hangs", .x = -2.7, .y = -1.2}, {.text = "upright", .x = 0.15, .y = 1.2}},
                .width = 720,
                .height = 560};
  figure.heatMap->contours = 10;
  Vector2d x(-kPi + 1e-3, 0);
  Series path{.size = 2, .color = Color{0.95f, 0.35f, 0.1f}};
  for (int t = 0; t < 2000; ++t) {
    append(path, x);
    const double u = grid.control(x);
    x += 0.005 * problem.rate(x + 0.0025 * problem.rate(x, u), u);
    if (std::abs(x[0]) <= kPi) continue;
    x[0] -= std::copysign(2 * kPi, x[0]);  // comes in again from the other side
    figure.series.push_back(path);
    path.x.clear(), path.y.clear();
  }
  figure.series.push_back(path);
  return figure;
}

// A cart with an upright pendulum, sampled at 10 Hz: the optimal regulator by iteration of Riccati's
// equation.
Figure polesOfARegulator() {
  Eigen::Matrix4d A = Eigen::Matrix4d::Identity();
  A(0, 1) = A(2, 3) = 0.1;
  A(1, 2) = -0.1 * 0.98, A(3, 2) = 0.1 * 10.8;
  const Eigen::Vector4d B(0, 0.1, 0, -0.1);
  Eigen::Matrix4d P = Eigen::Matrix4d::Identity();
  Eigen::RowVector4d K = Eigen::RowVector4d::Zero();
  for (int i = 0; i < 2000; ++i) {
    K = B.transpose() * P * A / (0.1 + B.dot(P * B));
    P = Eigen::Matrix4d::Identity() + A.transpose() * P * (A - B * K);
  }
  const auto poles = [](const Eigen::MatrixXd& M) {
    const Eigen::VectorXcd values = M.eigenvalues();
    return std::vector<std::complex<double>>(values.begin(), values.end());
  };
  Figure figure = poleFigure(poles(A), {}, TimeDomain::kDiscrete);
  figure.title = "A cart with a pendulum, at 10 Hz";
  figure.series[0].label = "without control";
  figure.series.push_back(poleFigure(poles(A - B * K), {}, TimeDomain::kDiscrete).series[0]);
  figure.series[1].label = "with regulator";
  return figure;
}

// The transfer function (s^2 + 2 s + 10) / ((s + 4) (s^2 + s + 6)).
Figure polesAndZeros() {
  const std::complex<double> zero(-1, 3), pole(-0.5, std::sqrt(5.75));
  return poleFigure({-4, pole, std::conj(pole)}, {zero, std::conj(zero)}, TimeDomain::kContinuous);
}

// A robot drives a circle, measures distance and bearing of the landmarks it sees, and corrects its odometry.
Figure localisation() {
  const std::vector<Vector2d> landmarks = {{6, 1}, {5.5, 6.5}, {0.5, 7.5}, {-3.5, 5}, {-3.5, 0.5}, {1, 3.4}};
  Figure figure{.title = "A robot localises itself with landmarks",
                .xLabel = "x [m]",
                .yLabel = "y [m]",
                .equalAxes = true,
                .legend = Legend::kOutside,
                .series = {{.label = "true path"},
                           {.label = "odometry alone", .dashed = true, .color = Color{0.5f, 0.5f, 0.5f}},
                           {.label = "Kalman filter", .color = Color{0.84f, 0.37f, 0}},
                           {.label = "landmarks",
                            .style = SeriesStyle::kPoints,
                            .marker = Marker::kTriangle,
                            .size = 2,
                            .color = Color{0.1f, 0.1f, 0.1f}}},
                .width = 760,
                .height = 540};
  for (const Vector2d& landmark : landmarks) append(figure.series[3], landmark);
  const auto moved = [](const Vector3d& pose, double ahead, double turn) {
    return Vector3d(pose.x() + ahead * std::cos(pose.z()), pose.y() + ahead * std::sin(pose.z()),
                    pose.z() + turn);
  };
  Rng rng(6);
  Vector3d truth = Vector3d::Zero(), odometry = truth, mean = truth;
  Matrix3d P = 1e-3 * Matrix3d::Identity();
  for (int i = 0; i < 95; ++i) {
    append(figure.series[0], Vector2d(truth.head<2>()));
    append(figure.series[1], Vector2d(odometry.head<2>()));
    append(figure.series[2], Vector2d(mean.head<2>()));
    if (i % 8 == 0)
      figure.ellipses.push_back({.mean = mean.head<2>(), .covariance = P.topLeftCorner<2, 2>()});
    const double ahead = 0.2, turn = 0.065;
    truth = moved(truth, ahead + 0.02 * rng.normal(), turn + 0.02 * rng.normal());
    odometry = moved(odometry, ahead, turn);
    Matrix3d F = Matrix3d::Identity();
    F(0, 2) = -ahead * std::sin(mean.z()), F(1, 2) = ahead * std::cos(mean.z());
    mean = moved(mean, ahead, turn);
    P = F * P * F.transpose();
    P.diagonal() += Vector3d(8e-4, 8e-4, 4e-4);
    if (i < 20 || i % 12 != 0) continue;
    for (const Vector2d& landmark : landmarks) {
      const Vector2d seen = landmark - truth.head<2>(), expected = landmark - mean.head<2>();
      if (seen.norm() > 3) continue;
      const double distance = expected.norm();
      Eigen::Matrix<double, 2, 3> H;
      H << -expected.x() / distance, -expected.y() / distance, 0, expected.y() / (distance * distance),
          -expected.x() / (distance * distance), -1;
      Vector2d innovation(seen.norm() + 0.1 * rng.normal() - distance,
                          std::atan2(seen.y(), seen.x()) - truth.z() + 0.05 * rng.normal() -
                              std::atan2(expected.y(), expected.x()) + mean.z());
      innovation.y() = std::remainder(innovation.y(), 2 * kPi);
      const Matrix2d S = H * P * H.transpose() + Vector2d(0.01, 0.0025).asDiagonal().toDenseMatrix();
      const Eigen::Matrix<double, 3, 2> K = P * H.transpose() * S.inverse();
      mean += K * innovation;
      P = ((Matrix3d::Identity() - K * H) * P).eval();
      P = ((P + P.transpose()) / 2).eval();
    }
  }
  figure.ellipses[0].label = "two standard deviations";
  return figure;
}

// A laser scanner goes through two rooms; each beam frees the cells it passes and fills the one it hits.
Figure gridMap() {
  const auto isWall = [](const Vector2d& p) {
    const bool outer = p.x() < 0.2 || p.x() > 9.8 || p.y() < 0.2 || p.y() > 5.8;
    const bool between = std::abs(p.x() - 5) < 0.1 && std::abs(p.y() - 3) > 0.7;
    const bool table = std::abs(p.x() - 7.5) < 0.6 && std::abs(p.y() - 1.6) < 0.4;
    return outer || between || table || (p - Vector2d(2.2, 4.2)).norm() < 0.4;
  };
  Figure figure{.title = "Grid map of two rooms",
                .xLabel = "x [m]",
                .yLabel = "y [m]",
                .equalAxes = true,
                .legend = Legend::kOutside,
                .series = {{.label = "path"}},
                .map = OccupancyCells{.xRange = {0, 10}, .yRange = {0, 6}},
                .width = 800,
                .height = 460};
  MatrixXd odds = MatrixXd::Zero(60, 100);  // logarithms
  Rng rng(3);
  for (double t = 0; t <= 1; t += 0.02) {
    const Vector2d p(1 + 7.5 * t, 3 - 1.1 * std::cos(kPi * t));
    append(figure.series[0], p);
    for (int beam = 0; beam < 120; ++beam) {
      const double angle = 2 * kPi * (beam + rng.uniform()) / 120;
      for (double r = 0; r < 3.5; r += 0.05) {
        const Vector2d q = p + r * Vector2d(std::cos(angle), std::sin(angle));
        double& cell = odds(static_cast<int>(q.y() * 10), static_cast<int>(q.x() * 10));
        cell += isWall(q) ? 0.9 : -0.1;
        if (isWall(q)) break;
      }
    }
  }
  figure.map->occupancy = (1 / (1 + (-odds.array()).exp())).matrix();
  return figure;
}

// The right hand of the figure of the course follows a circle by steps of inverse kinematics.
Figure handPath() {
  const Model model = compile(readOrs(sourcePath("data/robots/man.ors")).spec);
  const BodyId hand = model.body("handR");
  VectorXd q = VectorXd::Zero(model.nq());
  Figure figure{.title = "The right hand follows a circle",
                .xLabel = "x [m]",
                .yLabel = "y [m]",
                .zLabel = "z [m]",
                .equalAxes = true,
                .legend = Legend::kOutside,
                .series = {{.label = "target", .dashed = true, .color = Color{0.4f, 0.4f, 0.4f}},
                           {.label = "hand", .size = 1.3},
                           {.label = "below, on the ground", .size = 0.7, .color = Color{0.7f, 0.7f, 0.7f}}},
                .height = 540};
  const Vector3d start = position(forwardKinematics(model, q), hand, Vector3d::Zero());
  for (int i = 0; i <= 130; ++i) {
    const double angle = 2 * kPi * i / 100;
    const Vector3d target = start + Vector3d(0.1, -0.15, 0.1) +
                            0.2 * Vector3d(std::cos(angle), 0.5 * std::sin(angle), std::sin(angle));
    const BodyPoses poses = forwardKinematics(model, q);
    const Vector3d p = position(poses, hand, Vector3d::Zero());
    if (i <= 100) append(figure.series[0], target);
    append(figure.series[1], p);
    append(figure.series[2], Vector3d(p.x(), p.y(), 0.6));
    const MatrixXd J = positionJacobian(model, poses, hand, Vector3d::Zero());
    q += 0.4 * inverseKinematicsStep(J, target - p, 0.01);
  }
  figure.notes = {{.text = "start", .x = start.x(), .y = start.y(), .z = start.z()}};
  return figure;
}

// Seven values of a function, what a Gaussian process makes of them, and where a search evaluates it next.
Figure bayesianSearch() {
  const auto f = [](double x) {
    return std::sin(3 * x) + 0.5 * std::cos(7 * x + 1) + 0.15 * (x - 2) * (x - 2);
  };
  Figure figure{.title = "Bayesian optimisation: where to measure next?",
                .xLabel = "x [1]",
                .yLabel = "f [1]",
                .xRange = AxisRange{0, 4},
                .yRange = AxisRange{-3.1, 2.8},
                .legend = Legend::kOutside,
                .series = {{.label = "mean"},
                           {.label = "f, unknown", .dashed = true, .color = Color{0.4f, 0.4f, 0.4f}},
                           {.label = "measured",
                            .style = SeriesStyle::kPoints,
                            .marker = Marker::kDot,
                            .size = 2.2,
                            .color = Color{}},
                           {.label = "next",
                            .style = SeriesStyle::kPoints,
                            .marker = Marker::kTriangle,
                            .size = 2.2,
                            .color = Color{0.84f, 0.37f, 0}}},
                .bands = {{.label = "two deviations"}},
                .regions = {{.label = "expected improvement", .color = Color{0, 0.62f, 0.45f}}}};
  BayesianSearch search(VectorXd::Zero(1), VectorXd::Constant(1, 4));
  Rng rng(2);
  for (int i = 0; i < 7; ++i) {
    const VectorXd x = search.next(rng);
    append(figure.series[2], Vector2d(x[0], f(x[0])));
    search.add(x, f(x[0]));
  }
  const VectorXd next = search.next(rng);
  const double most = std::exp(search.acquisition(next)), bottom = -3;
  append(figure.series[3], Vector2d(next[0], search.process()->predict(next).mean));
  figure.verticalLines = {{.at = next[0]}};
  const auto above = [&](double x, double height) {
    figure.regions[0].x.push_back(x);
    figure.regions[0].y.push_back(bottom + height);
  };
  above(0, 0);
  for (int i = 0; i <= 400; ++i) {
    const VectorXd x = VectorXd::Constant(1, 0.01 * i);
    const GaussianPrediction at = search.process()->predict(x);
    append(figure.series[0], Vector2d(x[0], at.mean));
    append(figure.series[1], Vector2d(x[0], f(x[0])));
    figure.bands[0].x.push_back(x[0]);
    figure.bands[0].low.push_back(at.mean - 2 * at.deviation);
    figure.bands[0].high.push_back(at.mean + 2 * at.deviation);
    above(x[0], std::exp(search.acquisition(x)) / most);
  }
  above(4, 0);
  return figure;
}

}  // namespace

std::vector<std::pair<std::string, Figure>> galleryFigures() {
  return {{"line", stepResponses()},
          {"error-band", trackingError()},
          {"scatter", particles()},
          {"histogram", samplesOfAMixture()},
          {"belief", beliefInACorridor()},
          {"contour", costAndPaths()},
          {"phase-portrait", pendulum()},
          {"pendulum-value", valueOfAPendulum()},
          {"poles-discrete", polesOfARegulator()},
          {"poles-continuous", polesAndZeros()},
          {"covariance-ellipses", localisation()},
          {"map", gridMap()},
          {"path-3d", handPath()},
          {"bayes", bayesianSearch()}};
}

}  // namespace rex

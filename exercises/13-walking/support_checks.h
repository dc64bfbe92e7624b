#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"
#include "locomotion/footsteps.h"

// Part 1: the grader's contacts, and what must hold for polygons, margins and robots that stand on them.

/// The grid point nearest to p, so that cross products are exact.
inline Eigen::Vector2d onGrid(const Eigen::Vector2d& p, double lines) {
  return (p * lines).array().round() / lines;
}

inline Eigen::MatrixXd matrixOf(const std::vector<Eigen::Vector2d>& points) {
  Eigen::MatrixXd matrix(2, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) matrix.col(static_cast<Eigen::Index>(i)) = points[i];
  return matrix;
}

inline Eigen::MatrixXd shuffled(rex::Rng& rng, Eigen::MatrixXd columns) {
  for (Eigen::Index i = columns.cols() - 1; i > 0; --i)
    columns.col(i).swap(columns.col(rng.index(static_cast<int>(i) + 1)));
  return columns;
}

/// How far the flattest corner sticks out: if that is far enough, a tolerance for rounding does not change
/// the corners.
inline double leastCorner(const Eigen::MatrixXd& corners) {
  const Eigen::Index count = corners.cols();
  double out = INFINITY;
  for (Eigen::Index i = 0; i < count && count > 2; ++i) {
    const Eigen::Vector2d start = corners.col(i), along = corners.col((i + 2) % count) - start;
    const Eigen::Vector2d to = corners.col((i + 1) % count) - start;
    out = std::min(out, std::abs(along.x() * to.y() - along.y() * to.x()) / along.norm());
  }
  return out;
}

/// Contacts that span a polygon, with points on its edges, inside it, and duplicates.
inline Eigen::MatrixXd scattered(rex::Rng& rng) {
  for (;;) {
    std::vector<Eigen::Vector2d> points;
    const Eigen::Vector2d middle = rng.uniformVector(2, -1, 1);
    for (int i = 3 + rng.index(9); i > 0; --i)
      points.push_back(onGrid(middle + rng.uniformVector(2, -.4, .4), 256));
    const rex::SupportPolygon polygon = rex::supportPolygon(matrixOf(points));
    const Eigen::Index k = polygon.corners.cols();
    if (k < 3 || leastCorner(polygon.corners) < .005) continue;
    for (int doubled = 0; doubled < 4; ++doubled) {
      const int at = rng.index(static_cast<int>(k));
      const Eigen::Vector2d edge = polygon.corners.col((at + 1) % k) - polygon.corners.col(at);
      points.emplace_back(polygon.corners.col(at) + edge * (1 + rng.index(3)) / 4);
      points.push_back(points[static_cast<std::size_t>(rng.index(static_cast<int>(points.size())))]);
    }
    return shuffled(rng, matrixOf(points));
  }
}

/// Two soles side by side, 24 by 11 cm or so, with a contact in the middle of each side.
inline Eigen::MatrixXd twoSoles() {
  std::vector<Eigen::Vector2d> points;
  for (const double foot : {-.125, .125})
    for (const double x : {-.125, 0., .125})
      for (const double y : {-.0625, 0., .0625})
        if (x != 0 || y != 0) points.push_back({x, foot + y});
  return matrixOf(points);
}

/// Contacts on a line in any direction; all in one place if `count` is 1.
inline Eigen::MatrixXd inARow(rex::Rng& rng, int count) {
  const Eigen::Vector2d start = onGrid(rng.uniformVector(2, -.5, .5), 1024);
  Eigen::Vector2d step;
  do step = onGrid(rng.uniformVector(2, -.1, .1), 1024);
  while (step.norm() < .02);
  if (rng.index(3) == 0) step[rng.index(2)] = 0;
  if (step.isZero()) step.x() = .0625;
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < count; ++i) points.emplace_back(start + i * step);
  points.push_back(points.front());
  return shuffled(rng, matrixOf(points));
}

/// The polygon between these corners (2 x k) as a closed curve; nothing without corners.
inline rex::Series closedCurve(const Eigen::MatrixXd& corners, rex::Series curve) {
  if (corners.cols() == 0) return curve;
  curve = rex::through(corners, std::move(curve));
  return rex::through(corners.leftCols(1), std::move(curve));
}

/// The contacts with the returned polygon beside the wanted one.
inline rex::grading::Evidence supportSeen(const Eigen::MatrixXd& contacts, const Eigen::MatrixXd& corners,
                                          const Eigen::MatrixXd& wanted) {
  rex::Figure figure = rex::planeFigure({.title = "Support polygon", .legend = rex::Legend::kOutside});
  rex::Series yours = closedCurve(corners, rex::grading::gotCurve("your corners"));
  yours.style = rex::SeriesStyle::kLinesPoints;
  for (const rex::Series& curve : {yours, closedCurve(wanted, rex::grading::wantedCurve("wanted"))})
    if (!curve.x.empty()) figure.series.push_back(curve);
  figure.series.push_back(rex::dots(contacts, {.label = "contacts", .color = rex::Color{0, 0, 0}}));
  return {.figures = {figure}};
}

inline void cornersFit(rex::grading::Check& check, Student& student, const std::string& name,
                       const Eigen::MatrixXd& contacts) {
  check.input(name, {{"contacts", contacts}});
  const rex::SupportPolygon polygon = rex::supportPolygon(contacts);
  const Eigen::MatrixXd wanted = polygon.corners;
  const Eigen::MatrixXd corners = student.supportCorners(contacts);
  check.shape("corners of supportCorners", corners, 2, corners.cols());
  const auto shown = check.show([&] { return supportSeen(contacts, corners, wanted); });
  const auto k = static_cast<int>(wanted.cols());
  const auto count = static_cast<double>(corners.cols());
  bool areOnBorder = corners.cols() > k && k > 2;
  for (const Eigen::Vector2d corner : corners.colwise())
    areOnBorder = areOnBorder && std::abs(rex::supportMargin(polygon, corner).margin) < 1e-9;
  const auto onEdges =
      check.ask("Is a point counted that lies between two corners of an edge, or twice in the same place?",
                areOnBorder);
  check.near("number of corners of supportCorners", count, k, 0);
  if (k == 0) return;
  Eigen::Index begin = 0;
  (corners.colwise() - wanted.col(0)).colwise().norm().minCoeff(&begin);
  Eigen::MatrixXd turned(2, k), backwards = wanted;
  for (int i = 0; i < k; ++i) {
    turned.col(i) = corners.col((begin + i) % k);
    backwards.col(i) = wanted.col((k - i) % k);
  }
  const auto clockwise = check.ask("Are the corners clockwise?", (turned - backwards).isZero(1e-9));
  check.near("corners of supportCorners, counter-clockwise", turned, wanted, 1e-9, "m");
}

inline void marginFits(rex::grading::Check& check, Student& student, const Eigen::MatrixXd& contacts,
                       const Eigen::Vector2d& point) {
  const rex::SupportPolygon polygon = rex::supportPolygon(contacts);
  const Eigen::MatrixXd corners = polygon.corners;
  check.input("a polygon and a point", {{"corners", corners}, {"point", point}});
  check.near("borderDistance", student.borderDistance(corners, point),
             rex::supportMargin(polygon, point).margin, 1e-9, "m");
}

inline void marginsFit(rex::grading::Check& check, Student& student, const Eigen::MatrixXd& contacts) {
  rex::Rng& rng = check.rng();
  const Eigen::Vector2d middle = contacts.rowwise().mean();
  for (int i = 0; i < 5; ++i) marginFits(check, student, contacts, middle + .1 * rng.normalVector(2));
  for (int i = 0; i < 5; ++i) marginFits(check, student, contacts, middle + rng.normalVector(2));
  marginFits(check, student, contacts, contacts.col(0));
}

inline std::vector<MovingMass> randomRobot(rex::Rng& rng, const Eigen::Vector2d& over, double most) {
  std::vector<MovingMass> robot;
  for (int i = 2 + rng.index(6); i > 0; --i) {
    MovingMass part{.mass = std::exp(rng.uniform(-2, 3))};
    part.p << over + rng.uniformVector(2, -.4, .4), rng.uniform(.1, 1.5);
    part.a = rng.uniformVector(3, -most, most);
    robot.push_back(part);
  }
  return robot;
}

/// The masses of a robot and the columns of their positions, as an input.
inline void describe(rex::grading::Check& check, const std::string& name,
                     const std::vector<MovingMass>& robot, const rex::grading::InputValue& more) {
  Eigen::VectorXd masses(robot.size());
  Eigen::MatrixXd p(3, robot.size()), a = p;
  for (int i = 0; i < masses.size(); ++i) {
    const MovingMass& part = robot[static_cast<std::size_t>(i)];
    masses[i] = part.mass;
    p.col(i) = part.p;
    a.col(i) = part.a;
  }
  check.input(name, {{"masses", masses}, {"columns p", p}, {"columns a", a}, more});
}

inline void standsAsItShould(rex::grading::Check& check, Student& student, const Eigen::MatrixXd& contacts) {
  const std::vector<MovingMass> robot = randomRobot(check.rng(), contacts.rowwise().mean(), 3);
  describe(check, "a robot on contacts", robot, {"contacts", contacts});
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double whole = 0;
  for (const MovingMass& one : robot) {
    whole += one.mass;
    center += one.mass / whole * (one.p.head<2>() - center);
  }
  const rex::SupportPolygon polygon = rex::supportPolygon(contacts);
  check.near("staticMargin", student.staticMargin(robot, contacts),
             rex::supportMargin(polygon, center).margin, 1e-9, "m");
}

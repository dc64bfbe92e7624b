#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "course/clearances.h"
#include "exercise.h"
#include "scenes.h"

// The problems of main(), and how it draws them.

inline const rex::Color kBlue{0.1f, 0.35f, 0.65f}, kOrange{0.85f, 0.4f, 0.05f}, kGrey{0.55f, 0.58f, 0.6f},
    kPale{0.68f, 0.78f, 0.9f}, kBlack{0.1f, 0.1f, 0.1f};

inline rex::Series lineThrough(const std::string& label, const Eigen::MatrixXd& points,
                               const rex::Color& color, double size = 1.5) {
  rex::Series series{.label = label, .size = size, .color = color};
  for (Eigen::Index t = 0; t < points.cols(); ++t) {
    series.x.push_back(points(0, t));
    series.y.push_back(points(1, t));
  }
  return series;
}

inline rex::Region roundRegion(double x, double y, double radius, const std::string& label = "") {
  rex::Region region{.label = label};
  for (int i = 0; i < 72; ++i) {
    const double angle = 2 * std::numbers::pi * i / 72;
    region.x.push_back(x + radius * std::cos(angle));
    region.y.push_back(y + radius * std::sin(angle));
  }
  return region;
}

/// A point that comes from rest at one place to rest at another, and keeps out of a disc.
struct DiscPath {
  Eigen::Vector2d from{-1, 0}, to{1, 0.1}, center{0, 0.15};
  double radius = 0.4, tau = 0.05;
  int steps = 40;

  /// The straight way.
  [[nodiscard]] Eigen::MatrixXd guess() const {
    Eigen::MatrixXd X(2, steps);
    for (int t = 0; t < steps; ++t) X.col(t) = from + (t + 1.) / steps * (to - from);
    return X;
  }

  [[nodiscard]] std::vector<Term> termsAt(const Eigen::MatrixXd& X,
                                          TermValue (*difference)(const Eigen::MatrixXd&, double)) const {
    std::vector<Term> terms;
    const auto x = [&](int t) { return t < 0 ? from : Eigen::Vector2d(X.col(t)); };
    Eigen::MatrixXd three(2, 3);
    for (int t = 0; t < steps; ++t) {
      for (int i = 0; i < 3; ++i) three.col(i) = x(t - 2 + i);
      const TermValue acceleration = difference(three, tau);
      terms.push_back({Role::cost, t, acceleration.y, acceleration.J});
      terms.push_back(outside(x(t), t));
    }
    for (const int t : {steps - 1, steps - 2})
      terms.push_back({Role::equality, t, x(t) - to, Eigen::MatrixXd::Identity(2, 2)});
    return terms;
  }

  [[nodiscard]] Term outside(const Eigen::Vector2d& p, int t) const {
    const double distance = (p - center).norm();
    return {Role::inequality, t, Eigen::VectorXd::Constant(1, 1 - distance / radius),
            -(p - center).transpose() / (distance * radius)};
  }
};

inline rex::Figure discFigure(const DiscPath& disc, const Eigen::MatrixXd& X,
                              const Eigen::MatrixXd& byLibrary) {
  rex::Figure figure{.title = "Least acceleration past a disc",
                     .xLabel = "x [m]",
                     .yLabel = "y [m]",
                     .equalAxes = true,
                     .legend = rex::Legend::kOutside,
                     .width = 900,
                     .height = 430};
  figure.regions = {roundRegion(disc.center.x(), disc.center.y(), disc.radius)};
  rex::Series start = lineThrough("start", disc.guess(), kGrey),
              mine = lineThrough("optimised", X, kOrange, 1.2),
              library = lineThrough("library", byLibrary, kBlue, 1.2);
  start.dashed = true;
  mine.style = rex::SeriesStyle::kPoints;
  mine.marker = rex::Marker::kDot;
  figure.series = {start, library, mine};
  return figure;
}

inline rex::Figure roundsFigure(const Minimum& found) {
  rex::Figure figure{.title = "Rounds of the augmented Lagrangian",
                     .xLabel = "round",
                     .yLabel = "cost, violation [1]",
                     .logY = true};
  rex::Series cost{.label = "cost", .style = rex::SeriesStyle::kLinesPoints},
      violation{.label = "largest violation of a constraint", .style = rex::SeriesStyle::kLinesPoints};
  for (std::size_t i = 0; i < found.cost.size(); ++i) {
    cost.x.push_back(static_cast<double>(i) + 1);
    cost.y.push_back(found.cost[i] + 1e-12);
    violation.x.push_back(static_cast<double>(i) + 1);
    violation.y.push_back(found.violation[i] + 1e-12);
  }
  figure.series = {cost, violation};
  return figure;
}

inline rex::Figure viaFigure(const Eigen::MatrixXd& points, const Eigen::MatrixXd& X) {
  rex::Figure figure{.title = "Least acceleration through four points",
                     .xLabel = "x [m]",
                     .yLabel = "y [m]",
                     .legend = rex::Legend::kTopRight};
  rex::Series places = lineThrough("via points", points, kBlack);
  places.style = rex::SeriesStyle::kPoints;
  places.marker = rex::Marker::kCircle;
  rex::Series steps = lineThrough("one step each", X, kBlue, 0.7);
  steps.style = rex::SeriesStyle::kLinesPoints;
  steps.marker = rex::Marker::kDot;
  figure.series = {steps, places};
  return figure;
}

// The arm: corners of its links in its plane (y, z), 2 x 4.
inline Eigen::MatrixXd cornersOf(rex::Simulator& S, const Eigen::VectorXd& q) {
  S.setJointAngles(q);
  const Eigen::Vector3d half(0, 0, 0.15);
  Eigen::MatrixXd corners(2, 4);
  corners << S.kinematicsPos("arm1", -half).tail<2>(), S.kinematicsPos("arm2", -half).tail<2>(),
      S.kinematicsPos("eff", -half).tail<2>(), S.kinematicsPos("eff", half).tail<2>();
  return corners;
}

/// Configurations on the way, `each` to a step; the first is that at rest.
inline Eigen::MatrixXd finely(const Eigen::VectorXd& start, const Eigen::MatrixXd& X, int each) {
  Eigen::MatrixXd fine(X.rows(), X.cols() * each + 1);
  fine.col(0) = start;
  for (Eigen::Index i = 1; i < fine.cols(); ++i) {
    const Eigen::Index t = (i - 1) / each;
    const double share = static_cast<double>(i - t * each) / each;
    const Eigen::VectorXd before = t == 0 ? start : Eigen::VectorXd(X.col(t - 1));
    fine.col(i) = before + share * (X.col(t) - before);
  }
  return fine;
}

inline Eigen::MatrixXd handPath(rex::Simulator& S, const Eigen::MatrixXd& X) {
  const Eigen::MatrixXd fine = finely(kArmStart, X, 8);
  Eigen::MatrixXd path(2, fine.cols());
  for (Eigen::Index i = 0; i < fine.cols(); ++i) path.col(i) = cornersOf(S, fine.col(i)).rightCols<1>();
  return path;
}

inline rex::Figure armFigure(rex::Simulator& S, const std::vector<Ball>& balls, const Eigen::MatrixXd& guess,
                             const Eigen::MatrixXd& X) {
  rex::Figure figure{.title = "The arm around the ball, seen from the front",
                     .xLabel = "y [m]",
                     .yLabel = "z [m]",
                     .equalAxes = true,
                     .legend = rex::Legend::kOutside,
                     .width = 900,
                     .height = 640};
  for (const Ball& ball : balls) figure.regions.push_back(roundRegion(ball.y, ball.z, ball.radius));
  for (Eigen::Index k = 0; k < X.cols(); ++k)
    figure.series.push_back(lineThrough(k == 0 ? "links" : "", cornersOf(S, X.col(k)), kPale, 1));
  figure.series.push_back(lineThrough("hand, detour", handPath(S, guess), kGrey));
  figure.series.back().dashed = true;
  figure.series.push_back(lineThrough("hand, optimised", handPath(S, X), kOrange, 3));
  return figure;
}

inline rex::Figure clearanceFigure(rex::Simulator& S,
                                   const std::vector<std::pair<std::string, Eigen::MatrixXd>>& motions) {
  rex::Figure figure{.title = "Distance of the nearest pair, also between steps",
                     .xLabel = "time [s]",
                     .yLabel = "distance [m]",
                     .legend = rex::Legend::kOutside,
                     .horizontalLines = {{.at = kErrand.margin, .label = "margin"}},
                     .width = 900};
  for (const auto& [label, X] : motions) {
    rex::Series series{.label = label};
    const Eigen::MatrixXd fine = finely(kArmStart, X, 8);
    for (Eigen::Index i = 0; i < fine.cols(); ++i) {
      S.setJointAngles(fine.col(i));
      series.x.push_back(static_cast<double>(i) / 8 * kErrand.tau);
      series.y.push_back(rex::clearances(S).y.minCoeff());
    }
    figure.series.push_back(series);
  }
  return figure;
}

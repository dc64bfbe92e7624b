#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "course/clearances.h"
#include "exercise.h"
#include "scenes.h"

// The problems of main(), and how it draws them. Numbers are set one by one here: that compiles fast.

inline const rex::Color kBlue{0.1f, 0.35f, 0.65f}, kOrange{0.85f, 0.4f, 0.05f}, kGrey{0.55f, 0.58f, 0.6f},
    kPale{0.68f, 0.78f, 0.9f};

enum class Pen { line, dashes, dots, beads };

/// The points (x, y) of a curve, one per column.
struct Curve {
  std::string label;
  Eigen::MatrixXd points;
  rex::Color color;
  Pen pen = Pen::line;
  double size = 1.5;
};

struct Sheet {
  std::string title, xLabel, yLabel;
  std::vector<Curve> curves;
  std::vector<Ball> balls{};
  bool isMap = false, isLogarithmic = false;
  int width = 900, height = 500;
};

inline rex::Figure figureOf(const Sheet& sheet) {
  rex::Figure figure;
  figure.title = sheet.title;
  figure.xLabel = sheet.xLabel;
  figure.yLabel = sheet.yLabel;
  figure.equalAxes = sheet.isMap;
  figure.logY = sheet.isLogarithmic;
  figure.legend = rex::Legend::kOutside;
  figure.width = sheet.width;
  figure.height = sheet.height;
  for (const Ball& ball : sheet.balls) {
    rex::Region& region = figure.regions.emplace_back();
    for (int i = 0; i < 72; ++i) {
      const double angle = 2 * std::numbers::pi * i / 72;
      region.x.push_back(ball.y + ball.radius * std::cos(angle));
      region.y.push_back(ball.z + ball.radius * std::sin(angle));
    }
  }
  for (const Curve& curve : sheet.curves) {
    rex::Series& series = figure.series.emplace_back();
    series.label = curve.label;
    series.color = curve.color;
    series.size = curve.size;
    series.dashed = curve.pen == Pen::dashes;
    if (curve.pen == Pen::dots) series.style = rex::SeriesStyle::kPoints;
    if (curve.pen == Pen::beads) series.style = rex::SeriesStyle::kLinesPoints;
    series.marker = rex::Marker::kDot;
    for (Eigen::Index i = 0; i < curve.points.cols(); ++i) {
      series.x.push_back(curve.points(0, i));
      series.y.push_back(curve.points(1, i));
    }
  }
  return figure;
}

/// A point that comes from rest at one place to rest at another, and keeps out of a disc.
struct DiscPath {
  Eigen::Vector2d from{-1, 0}, to{1, 0.1};
  Ball disc{0, 0.15, 0.4};
  double tau = 0.05;
  int steps = 40;

  /// The straight way.
  [[nodiscard]] Eigen::MatrixXd guess() const {
    Eigen::MatrixXd X(2, steps);
    for (int t = 0; t < steps; ++t)
      for (int i = 0; i < 2; ++i) X(i, t) = from[i] + (t + 1.) / steps * (to[i] - from[i]);
    return X;
  }

  [[nodiscard]] std::vector<Term> termsAt(const Eigen::MatrixXd& X,
                                          TermValue (*difference)(const Eigen::MatrixXd&, double)) const {
    std::vector<Term> terms;
    Eigen::MatrixXd three(2, 3);
    for (int t = 0; t < steps; ++t) {
      for (int i = 0; i < 6; ++i) three(i % 2, i / 2) = t + i / 2 < 2 ? from[i % 2] : X(i % 2, t - 2 + i / 2);
      const TermValue acceleration = difference(three, tau);
      terms.push_back({Role::cost, t, acceleration.y, acceleration.J});
      terms.push_back({Role::inequality, t, {}, {}});
      outside(X(0, t), X(1, t), terms.back().y, terms.back().J);
    }
    for (const int t : {steps - 1, steps - 2}) {
      Eigen::VectorXd away(2);
      for (int i = 0; i < 2; ++i) away[i] = X(i, t) - to[i];
      terms.push_back({Role::equality, t, away, Eigen::MatrixXd::Identity(2, 2)});
    }
    return terms;
  }

  /// 1 - distance / radius at (x, y), and its Jacobian.
  void outside(double x, double y, Eigen::VectorXd& value, Eigen::MatrixXd& J) const {
    const double distance = std::hypot(x - disc.y, y - disc.z);
    value.resize(1);
    value[0] = 1 - distance / disc.radius;
    J.resize(1, 2);
    J(0, 0) = -(x - disc.y) / (distance * disc.radius);
    J(0, 1) = -(y - disc.z) / (distance * disc.radius);
  }
};

inline rex::Figure discFigure(const DiscPath& path, const Eigen::MatrixXd& X,
                              const Eigen::MatrixXd& byLibrary) {
  return figureOf({.title = "Least acceleration past a disc",
                   .xLabel = "x [m]",
                   .yLabel = "y [m]",
                   .curves = {{"start", path.guess(), kGrey, Pen::dashes},
                              {"library", byLibrary, kBlue},
                              {"optimised", X, kOrange, Pen::dots}},
                   .balls = {path.disc},
                   .isMap = true,
                   .height = 430});
}

inline Eigen::MatrixXd overRounds(const std::vector<double>& values) {
  Eigen::MatrixXd points(2, static_cast<Eigen::Index>(values.size()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    points(0, i) = static_cast<double>(i) + 1;
    points(1, i) = values[static_cast<std::size_t>(i)] + 1e-12;
  }
  return points;
}

inline rex::Figure roundsFigure(const Minimum& found) {
  return figureOf({.title = "Rounds of the augmented Lagrangian",
                   .xLabel = "round",
                   .yLabel = "cost, violation [1]",
                   .curves = {{"cost", overRounds(found.cost), kBlue, Pen::beads},
                              {"largest violation", overRounds(found.violation), kOrange, Pen::beads}},
                   .isLogarithmic = true});
}

inline rex::Figure viaFigure(const Eigen::MatrixXd& points, const Eigen::MatrixXd& X) {
  return figureOf({.title = "Least acceleration through four points",
                   .xLabel = "x [m]",
                   .yLabel = "y [m]",
                   .curves = {{"one step each", X, kBlue, Pen::beads, 0.7},
                              {"via points", points, kOrange, Pen::dots, 1.7}}});
}

/// Configurations on the way, `each` to a step; the first is that at rest.
inline Eigen::MatrixXd finely(const Eigen::VectorXd& start, const Eigen::MatrixXd& X, int each) {
  Eigen::MatrixXd fine(X.rows(), X.cols() * each + 1);
  for (Eigen::Index i = 0; i < fine.cols(); ++i)
    for (Eigen::Index k = 0; k < fine.rows(); ++k) {
      const Eigen::Index t = std::max<Eigen::Index>(0, i - 1) / each;
      const double before = t == 0 ? start[k] : X(k, t - 1);
      fine(k, i) = before + static_cast<double>(i - t * each) / each * (X(k, t) - before);
    }
  return fine;
}

/// How the arm moves: its hand in its plane (y, z) and in space, and how near things are over time.
struct Swing {
  Eigen::MatrixXd hand, nearest;
  std::vector<Eigen::Vector3d> way;
};

inline Swing swingOf(rex::Simulator& S, const Eigen::MatrixXd& X) {
  constexpr int kEach = 8;
  const Eigen::MatrixXd fine = finely(kArmStart, X, kEach);
  Swing swing{Eigen::MatrixXd(2, fine.cols()), Eigen::MatrixXd(2, fine.cols()), {}};
  for (Eigen::Index i = 0; i < fine.cols(); ++i) {
    S.setJointAngles(fine.col(i));
    swing.way.push_back(S.kinematicsPos("eff", {0, 0, 0.15}));
    for (int k = 0; k < 2; ++k) swing.hand(k, i) = swing.way.back()[k + 1];
    swing.nearest(0, i) = static_cast<double>(i) / kEach * kErrand.tau;
    swing.nearest(1, i) = rex::clearances(S).y.minCoeff();
  }
  return swing;
}

/// The middles of the links in their plane (y, z): 2 x 4.
inline Eigen::MatrixXd linksOf(rex::Simulator& S, const Eigen::VectorXd& q) {
  S.setJointAngles(q);
  Eigen::MatrixXd corners(2, 4);
  for (int i = 0; i < 4; ++i) {
    const char* link = i == 0 ? "arm1" : i == 1 ? "arm2" : "eff";
    const Eigen::Vector3d p = S.kinematicsPos(link, {0, 0, i < 3 ? -0.15 : 0.15});
    corners(0, i) = p.y();
    corners(1, i) = p.z();
  }
  return corners;
}

/// Of all motions, the hand; of the last one the links too.
inline rex::Figure armFigure(rex::Simulator& S, const std::vector<Curve>& hands, const Eigen::MatrixXd& X) {
  Sheet sheet{.title = "The arm around the ball",
              .xLabel = "y [m]",
              .yLabel = "z [m]",
              .curves = {},
              .balls = kBall,
              .isMap = true,
              .width = 760,
              .height = 640};
  for (Eigen::Index step = 0; step < X.cols(); ++step)
    sheet.curves.push_back({step == 0 ? "links" : "", linksOf(S, X.col(step)), kPale, Pen::line, 1});
  for (const Curve& hand : hands) sheet.curves.push_back(hand);
  const double apart = 0.05 + kErrand.margin;
  Curve edge{"half a link and the margin away", Eigen::MatrixXd(2, 73), kGrey, Pen::line, 1};
  for (int i = 0; i < 73; ++i) {
    edge.points(0, i) = kBall[0].y + (kBall[0].radius + apart) * std::cos(2 * std::numbers::pi * i / 72);
    edge.points(1, i) = kBall[0].z + (kBall[0].radius + apart) * std::sin(2 * std::numbers::pi * i / 72);
  }
  sheet.curves.push_back(edge);
  return figureOf(sheet);
}

inline rex::Figure clearanceFigure(std::vector<Curve> distances) {
  Curve margin{"margin", Eigen::MatrixXd(2, 2), {0.1f, 0.1f, 0.1f}, Pen::line, 0.7};
  for (int i = 0; i < 2; ++i) {
    margin.points(0, i) = i * kErrand.steps * kErrand.tau;
    margin.points(1, i) = kErrand.margin;
  }
  distances.push_back(margin);
  return figureOf({.title = "Distance of the nearest pair, also between steps",
                   .xLabel = "time [s]",
                   .yLabel = "distance [m]",
                   .curves = distances});
}

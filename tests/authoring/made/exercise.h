#pragma once

#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. Metres and radians.

/// A body in the plane.
struct Body {
  Eigen::Vector2d p = Eigen::Vector2d::Zero();
  double angle = 0;
};

// Part 1, turning (2:9). Left turns count positive.

/// The point p [m] turned about the origin by `angle` [rad], counter-clockwise: the x axis turned by a
/// quarter is the y axis.
Eigen::Vector2d turned(const Eigen::Vector2d& p, double angle);
Eigen::VectorXd angles(const std::vector<Eigen::Vector2d>& points, int count = 3);

/// Whether the body stays where it is for so many steps.
bool isStill(const Body& body, int k, double wanted);

// Part 2, poses.

/// The pose after a random step.
rex::Pose posed(const rex::Pose& start, rex::Rng& rng);
/// The longest motions of the hand of S.
[[nodiscard]] std::vector<Eigen::VectorXd> longest(rex::Simulator& S, const Eigen::MatrixXd& A);

inline double given(double x) { return 2 * x; }

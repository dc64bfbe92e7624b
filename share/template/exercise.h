#pragma once

#include "course/course.h"

/// The point p [m] turned about the origin by `angle` [rad], counter-clockwise.
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double angle);

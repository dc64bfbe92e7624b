#pragma once

#include <string>
#include <vector>

#include "exercise.h"

/// A motion: N + 1 states and N torques, held for tau seconds each. Torques may be missing.
struct Motion {
  std::string label{};
  Eigen::MatrixXd X{};
  Eigen::VectorXd U{};
  double tau = .01;
};

/// The library's results: the value on its grid, a plan's cost from the same first torques, and the gains K
/// (for u = K x) and P of a regulator for small angles, as a Swing without a level.
double costByTheLibrary(const Decision& decision, const Eigen::Vector2d& x);
double priceByTheLibrary(const Journey& journey, const Eigen::VectorXd& U);
Swing regulatorOfTheLibrary(const Pendulum& pendulum);

/// x' under u = K x, limited to what the motor can.
Flow flowOf(const Pendulum& pendulum, const Eigen::RowVector2d& K);

/// values.png: V over all states, and the motion.
void showValues(const Grid& grid, const Eigen::MatrixXd& V, const Motion& motion);

/// gains.png: gainsOverTime() upright. Long before the end they are constant.
void showGains(const Pendulum& pendulum);

/// region.png: where V = x^T P x is proved to fall, where it rises, and from where the motor really brings
/// the pendulum up.
void showRegion(const Pendulum& pendulum, const Swing& swing);

/// angles.png, energies.png, swings_sheet.png, swings.mp4: the motions side by side.
void showMotions(const Pendulum& pendulum, const std::vector<Motion>& motions);

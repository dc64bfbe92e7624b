#pragma once

#include <cmath>

#include "exercise.h"

// A pole on a motor, which tips over. The state is its angle [rad] and rate [rad/s]; the action is a torque
// divided by the inertia. It fails beyond half a radian. The reward of a step is highest upright and at
// rest.

inline constexpr int kPoleHorizon = 100;

inline Eigen::VectorXd poleStart(rex::Rng& rng) { return .1 * rng.normalVector(2); }

/// One step of 20 ms, with a random push.
inline StepFunction poleStep(rex::Rng& rng) {
  return [&rng](const Eigen::VectorXd& state, double action) {
    constexpr double tau = .02;
    const double rate = state[1] + tau * (10 * std::sin(state[0]) + action) + .02 * rng.normal();
    const double angle = state[0] + tau * rate;
    const double cost = 4 * angle * angle + .05 * rate * rate + .0005 * action * action;
    return Transition{Eigen::Vector2d(angle, rate), std::exp(-cost), std::abs(angle) > .5};
  };
}

#pragma once

#include "exercise.h"

/// random.png: the values of the cells of the floor under a random walk. improved.png: the best actions by
/// these values lead away from the pit, and to the goal where it is near.
void showRandomWalk();

/// optimal.png and policy.png: the optimal values of the cells, and the best way. convergence.png: how far
/// both iterations are from these values, step by step.
void showOptimum(double tolerance);

/// rollouts.png: the angle [rad] of the pole over time in a few trials of this policy; it soon falls.
void showRollouts(const Policy& policy);

/// learning.png: returns of ten runs of REINFORCE, the natural gradient and PoWER, mean and spread; the
/// maximum is 100. degrees.png: the same if the angle is in degrees, with the same rules for the step size.
void showLearning(const Policy& first);

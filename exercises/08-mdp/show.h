#pragma once

#include "exercise.h"

/// random.png: what the cells of the floor are worth to somebody who walks at random. improved.png: the
/// actions that are best by these values flee the pit, and lead to the goal where it is near.
void showRandomWalk();

/// optimal.png and policy.png: the optimal values of the cells, and the best way. convergence.png: how far
/// both iterations are from these values, step by step.
void showOptimum(double tolerance);

/// rollouts.png: the angle [rad] of the pole over time in a few trials of this policy; it soon falls.
void showRollouts(const Policy& policy);

/// learning.png: returns of ten runs of REINFORCE and of PoWER, mean and spread; 100 is the most there is.
void showLearning(const Policy& first);

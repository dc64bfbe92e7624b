#pragma once

#include "exercise.h"

/// q.png and sarsa.png: what both learn about a cliff in 500 episodes. learning.png: returns of 30 runs.
void showCliff(double epsilon);

/// explored.png: how many pairs of state and action are known after each step in a maze, for R-max and for
/// actions drawn by chance.
void showExploration();

/// bandits.png: what the best arm would have paid more, for upper confidence bounds and for epsilon-greedy
/// choices, 30 runs each.
void showBandits(double epsilon);

#pragma once

#include "exercise.h"

/// q.png and sarsa.png: what both learn about a cliff in 500 episodes. learning.png: returns of 30 runs.
void showCliff(double epsilon);

/// explored.png: how many pairs of state and action are known after each step in a maze, for R-max and for
/// actions drawn by chance.
void showExploration();

/// cloned.png: the policy of a clone of one demonstration on dry ground, and where it gets on slippery
/// ground; aggregated.png: the same after 80 rounds of aggregation. drift.png: chances of mistakes, 30 runs
/// each.
void showImitation();

/// wishes.png: the likes of a teacher and its policy; inferred.png: what its walks reveal of both. gap.png:
/// how much less the mixture gets than the teacher, after each round.
void showTeacher();

/// bandits.png: what the best arm would have paid more, for upper confidence bounds and for epsilon-greedy
/// choices, 30 runs each.
void showBandits(double epsilon);

#pragma once

#include "exercise.h"

/// A trolley that is driven with at most 1 m/s^2, from any state (position, speed) to rest at 0: steps of
/// 0.1 s, N = 40, and F from costToGo().
Task trolleyTask();

/// Prints how far a predicted motion is from the one that happens.
void showPrediction(const Plant& plant);

/// horizons.png: the first control of a plan without bounds, for horizons of 1 to 40 steps, with F and
/// with Q in place of F, beside that of the library's LQR.
void showHorizons(const Task& task);

/// box.png: the cost of two numbers with bounds, its minimum, the same cut off, and the result of boxed().
void showBox();

/// trolley.png: LQR with its control cut off, and plans of 5 and 40 steps, from 5 m.
void showTrolley(const Task& task);

/// pole.png: from how far a weak motor brings a pole back, by LQR cut off and by plans of several lengths.
/// balanced.mp4: one of these drives.
void showPole();

/// line.png: a planar arm whose joints are too slow for a line, and reach their limits on it: by traced(),
/// and by the pseudo-inverse with its rates cut off.
void showLine();

/// wall.png: a wall 0.1 m behind the goal, for several weights.
void showWall(const Task& task);

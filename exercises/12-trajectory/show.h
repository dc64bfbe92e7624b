#pragma once

#include <vector>

#include "exercise.h"

/// Prints the cost of 3 s^2 - 2 s^3 from s = 0 to 1, which tends to 12 with more steps, and whether the
/// Jacobian of taskDifference() fits its values.
void showCosts();

/// descent.png: from the straight way through a disc to a way around it, step by step. With a penalty
/// alone, the way still cuts into the disc.
void showDescent();

/// disc.png: with constraints the points keep out of the disc, and lie on the line of the library.
/// rounds.png: how the violation falls while the cost rises.
void showDisc();

/// Prints the least cost from 0 to 1 in a second for three numbers of steps, and what it should be.
void showReach();

/// via.png: your curve from (0, 0) through these points [m]; it does not stop before the last.
void showVia(const Eigen::MatrixXd& points, const std::vector<int>& when, double tau);

/// arm.png, clearance.png, around.mp4, around.html, around_sheet.png: the hand just misses the ball, the
/// nearest pair is never nearer than the margin, and the motion costs less than the detour.
void showArm();

#pragma once

#include <string>

#include "exercise.h"

/// The joints that lead to `body`, as they are in the robot, each with one coordinate.
Chain chainOf(const rex::Simulator& S, const std::string& body);

/// turns.mp4, turns_sheet.png: a frame turns from one orientation to another, on the left by between(), on
/// the right by Euler angles that change at constant rates. turns.png: how fast each turns.
void showTurns();

/// lock_sheet.png: the three axes of kYawPitchRoll while pitch grows to a quarter turn, where two coincide.
/// lock.png: the smallest singular value of turningAxes() over the second angle.
void showLock();

/// ellipse.mp4, ellipse_sheet.png: the ellipsoid of an arm of three joints that stretches. ellipse.png: its
/// radii and the measure.
void showEllipse();

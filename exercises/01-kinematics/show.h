#pragma once

#include "exercise.h"

/// A motion of the robot in man.ors, without the posture it started from.
using Postures = std::vector<Eigen::VectorXd>;

/// errors.png: the distance of the right hand from `goal` (metres, in the world) after each step. Steps of
/// a tenth lie on the library's dashed line.
void showReaching(const Postures& fullSteps, const Postures& tenths, const Postures& line,
                  const Eigen::Vector3d& goal);

/// circle.mp4 and circle.html: three turns, recorded in `turns`. circle.png, posture.png: in a long run the
/// right hand follows the circle of radius 0.2 m around `center`, but the posture drifts.
void showCircle(const rex::Simulator& turns, const Postures& longRun, const Eigen::Vector3d& center);

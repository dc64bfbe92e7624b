#pragma once

#include "exercise.h"

/// support.png: two soles centred here [m], seen from above, and their hull; the distance from its
/// border grows to a ridge in the middle. Prints a static margin beside the library's.
void showSupport(const Eigen::Vector2d& left, const Eigen::Vector2d& right);

/// tipping.png: the zero moment point of a body that stands on one sole moves back as the body accelerates
/// forwards.
void showTipping();

/// capture.png: over the capture point the motion dies out; 2 cm beside it, the body falls back or keeps
/// going.
void showCapture(const Pendulum& pendulum, const Sway& now);

/// gains.png: the gains of the preview, and the library's curve.
void showGains(const CartTable& cart, const PreviewLaw& law);

/// zmp.png and zmp_time.png: a walk around a bend, from above and over time; humanoid.mp4, once the zero
/// moment point keeps within 5 cm of its reference: a humanoid on this walk.
void showWalk(const CartTable& cart, const PreviewLaw& law);

/// horizon.png: the largest error of the same walk falls with a longer preview.
void showHorizon(const CartTable& cart, const PreviewLaw& law);

/// phase.png and walker.mp4: steps from a guess, and the gait near it; settling.png: how fast the walk
/// approaches the gait.
void showCompass(const Walker& walker, const Eigen::Vector4d& guess);

/// slopes.png: the largest multiplier on slopes of 1.5 to 5 degrees; above 1 the gait is unstable. The guess
/// is for 3 degrees.
void showSlopes(const Eigen::Vector4d& guess);

#pragma once

#include "exercise.h"

/// fit.png: a polynomial of degree 9 through twelve noisy samples of a sine. The fit by equationC lies on the
/// library's dashed line and oscillates between the points; the fit by equationD, with B = 0.01 Id, is calm.
void showFit();

/// paths.png, convergence.png: gradientDescent wanders along a curved valley, gaussNewton soon arrives.
void showDescents(const Eigen::Vector2d& start);

/// book.png: the book before and after, a dot on it, and a point on the table. Metres.
void showBook(const Eigen::Matrix3d& X_WB, const Eigen::Vector2d& dot_B, const Eigen::Vector2d& point_W);

/// product.png: the ellipse of the product lies where both others overlap, and is smaller than either.
void showProduct();

/// propagation.png: robots drive blindly ahead and to the left, and the belief spreads with them. Metres.
void showPropagation();

/// beta.png: the belief about a coin sharpens, throw by throw, around the true P(x = 1).
void showCoin(const BetaBelief& prior, double truth);

/// dirichlet.png: the same for three outcomes. The line joins what nextOutcome returned after every turn.
void showWheel(const Eigen::Vector3d& truth);

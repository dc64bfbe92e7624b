#pragma once

#include "exercise.h"

/// Prints M, F, B and the energy at the state x, and the library's for all but B.
void showEquation(const RacerModel& racer, const Eigen::Vector4d& x);

/// energy.png: without control, from this tilt [rad], your steps conserve the energy far better than
/// Euler's. Prints the standard deviation of the noise of one second.
void showEnergy(const RacerModel& racer, double tilt);

/// lqr.png: x [m] and theta [rad] from a tilt of 0.2 rad, held by your gain, match those of the library's
/// gain.
void showLqr(const Linear& system, const Eigen::Matrix4d& Q, double R);

/// features.png: the averages follow a reading that jumps, and the rate shows when it does.
void showFeatures();

/// rides.png: x [m] and theta [rad] of a ride under the policy w; the pendulum stands, and the wheel sways.
void showRides(const Eigen::VectorXd& w);

/// evolution.png: how low your strategy and CMA-ES get on a round bowl, and on one that is a hundred times as
/// long as wide.
void showEvolution();

/// Searches in your simulator. drift.png: how far the wheel sways in 100 s, compared with the policy
/// `direct`; robust.png: how many rides last, with more and more noise; learning.png: costs during your
/// search and during ten more in the library's simulator; learnt.mp4: the racer before, during and after
/// the search. Returns what was found.
Eigen::VectorXd showSearch(const Eigen::VectorXd& direct);

/// sensed.png: a ride under a policy, one under another that your search finds by the costs of the sensors,
/// and where the sensors say the first one is.
void showSensed(const Eigen::VectorXd& policy);

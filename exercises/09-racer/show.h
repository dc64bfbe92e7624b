#pragma once

#include "exercise.h"

/// Prints M, F, B and the energy at the state x; but for B, the library's, too.
void showEquation(const RacerModel& racer, const Eigen::Vector4d& x);

/// energy.png: without control, from this tilt [rad], your steps keep the energy far better than Euler's.
/// Prints what the noise of one second amounts to.
void showEnergy(const RacerModel& racer, double tilt);

/// lqr.png: x [m] and theta [rad] from a tilt of 0.2 rad, held by your gain, lie on those of the library's.
void showLqr(const Linear& system, const Eigen::Matrix4d& Q, double R);

/// features.png: the averages follow a reading that jumps, and the rate shows when it does.
void showFeatures();

/// rides.png: x [m] and theta [rad] of a ride under the policy w; the pendulum stands, and the wheel sways.
void showRides(const Eigen::VectorXd& w);

/// Searches in your simulator. drift.png: how far the wheel sways in 100 s, compared with the policy
/// `direct`; robust.png: how many rides last, with more and more noise; learning.png: costs while the search
/// goes on, of yours and of ten more in the library's simulator; learnt.mp4: before, on the way and after.
void showSearch(const Eigen::VectorXd& direct);

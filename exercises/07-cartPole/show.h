#pragma once

#include <string>
#include <vector>

#include "exercise.h"

/// The library's results: A and B of the cart pole; the optimal gains, for u = K x; and the slowest pole
/// that its search finds from `start`, with no gain larger than the largest of `start`.
Plant plantOfTheLibrary();
Eigen::MatrixXd gainsOfTheLibrary(const Plant& plant, const Costs& costs);
double slowestOfTheLibrary(const Plant& plant, const Eigen::MatrixXd& start);

/// A by finite differences of rateOf(), 4 x 4.
Eigen::MatrixXd differencesByState(const PoleCart& cart);

/// theta.png, position.png, force.png: from several angles, without noise. Up to 1.0 rad the pole comes back.
void showOutings(const Eigen::MatrixXd& K);

/// survival.png: the share of outings with noise that do not end in a fall, with K and with the sheet's K.
void showSurvival(const Eigen::MatrixXd& K, const Eigen::MatrixXd& printed);

/// balanced.mp4: an outing with noise from 0.4 rad. Prints how far an outing without noise is from the
/// library's.
void showBalance(const Eigen::MatrixXd& K);

/// Prints fateOf() for three motions.
void showFates();

/// poles.png: without control, and with three controllers. The quick K leaves several poles equally slow.
void showPoles(const Plant& real, const Eigen::MatrixXd& K, const Eigen::MatrixXd& printed,
               const Eigen::MatrixXd& quick);

/// quick.png: cart and pole from 0.2 rad, with the optimal gains and with the quick ones.
void showQuick(const Eigen::MatrixXd& K, const Eigen::MatrixXd& quick);

/// The noise of x' and y, if in each step of 1/60 s random numbers of that size are added to p' and theta',
/// and others to each of the measurements.
Noise noiseOfSteps(double ofRates, double ofSensors, int sensors);
Eigen::MatrixXd observerGainOfTheLibrary(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C,
                                         const Noise& noise);

/// What is measured, y = C x, and the gain of its observer.
struct Sensor {
  std::string label;
  Eigen::MatrixXd C, L;
};

/// seen.png: the cart pole under u = K x^ with noise of 0.005, and what the observer believes, whose one
/// measurement is wrong by 0.002. Prints the slowest pole of both together.
void showSeen(const Eigen::MatrixXd& K, const Sensor& sensor);

/// bode.png, nyquist.png: the loop, cut open at u, if x is known and with each sensor.
void showLoops(const Plant& real, const Eigen::MatrixXd& K, const std::vector<Sensor>& sensors);

/// margins.png: the slowest pole of each if the force is a multiple of what the controller wants.
void showMargins(const Plant& real, const Eigen::MatrixXd& K, const std::vector<Sensor>& sensors);

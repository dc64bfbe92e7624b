#pragma once

#include "course/car_simulator.h"
#include "legacy/array.h"
#include "systems/cart_pole.h"
#include "systems/racer.h"

namespace rex::legacy {

/// course/car_simulator.h with arrays: what is asked for comes back in the first argument.
class CarSimulator {
 public:
  void step(const arr& u) { car_.step(u.vector()); }
  void getRealNoisyObservation(arr& y) { y = arr(car_.getRealNoisyObservation()); }
  void getMeanObservationAtState(arr& y, const arr& x) const;
  void getObservationJacobianAtState(arr& C, const arr& x) const;
  void getObservationJacobian(arr& C, const arr& x) const { getObservationJacobianAtState(C, x); }
  void getLinearObservationModelAtState(arr& C, arr& c, const arr& x) const;
  void getMeanObservationAtStateAndLandmarks(arr& y, const arr& x, const arr& landmarks) const;
  void getObservationJacobianAtStateAndLandmarks(arr& J, const arr& x, const arr& landmarks) const;
  /// The truth, to compare with: (x, y, heading), and a landmark per row.
  void getState(arr& x) const { x = arr(Eigen::VectorXd(car_.getState())); }
  void getLandmarks(arr& landmarks) const {
    landmarks = arr(Eigen::MatrixXd(car_.getLandmarks().transpose()));
  }

 private:
  rex::CarSimulator car_;
};

/// course/cart_pole.h with its state as an array (p, p', theta, theta').
class CartPole {
 public:
  arr x = ARR(0, 0, .2, 0);
  void step(double u);

 private:
  rex::CartPole cartPole_;
};

/// course/racer.h with arrays: q = (x, theta) and its velocities.
class Racer {
 public:
  arr q = ARR(0, .01), q_dot = ARR(0, 0);
  void stepDynamics(double u);
  void getObservation(arr& y);
  void getDynamics(arr& M, arr& F, arr& B);

 private:
  void copyState();

  rex::Racer racer_;
};

}  // namespace rex::legacy

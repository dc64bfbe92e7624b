#include "legacy/toy_systems.h"

#include "base/error.h"

namespace rex::legacy {

void CarSimulator::getMeanObservationAtState(arr& y, const arr& x) const {
  y = arr(car_.getMeanObservationAtState(x.vector()));
}

void CarSimulator::getObservationJacobianAtState(arr& C, const arr& x) const {
  C = arr(car_.getObservationJacobianAtState(x.vector()));
}

void CarSimulator::getLinearObservationModelAtState(arr& C, arr& c, const arr& x) const {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd offset;
  car_.getLinearObservationModelAtState(matrix, offset, x.vector());
  C = arr(matrix);
  c = arr(offset);
}

void CarSimulator::getMeanObservationAtStateAndLandmarks(arr& y, const arr& x, const arr& landmarks) const {
  y = arr(car_.getMeanObservationAtStateAndLandmarks(x.vector(), landmarks.vector()));
}

void CarSimulator::getObservationJacobianAtStateAndLandmarks(arr& J, const arr& x,
                                                             const arr& landmarks) const {
  J = arr(car_.getObservationJacobianAtStateAndLandmarks(x.vector(), landmarks.vector()));
}

void CartPole::step(double u) {
  requireSize("CartPole: x", x.vector().size(), 4);
  cartPole_.x = x.vector();
  cartPole_.step(u);
  x = arr(Eigen::VectorXd(cartPole_.x));
}

void Racer::copyState() {
  requireSize("Racer: q", q.vector().size(), 2);
  requireSize("Racer: q_dot", q_dot.vector().size(), 2);
  racer_.q = q.vector();
  racer_.v = q_dot.vector();
}

void Racer::stepDynamics(double u) {
  copyState();
  racer_.stepDynamics(u);
  q = arr(Eigen::VectorXd(racer_.q));
  q_dot = arr(Eigen::VectorXd(racer_.v));
}

void Racer::getObservation(arr& y) {
  copyState();
  y = arr(Eigen::VectorXd(racer_.getObservation()));
}

void Racer::getDynamics(arr& M, arr& F, arr& B) {
  copyState();
  Eigen::MatrixXd mass;
  Eigen::VectorXd force, torque;
  racer_.getDynamics(mass, force, torque);
  M = arr(mass);
  F = arr(force);
  B = arr(torque);
}

}  // namespace rex::legacy

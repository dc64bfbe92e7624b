#include "course/racer.h"

#include "base/require.h"

namespace rex {

Racer::Racer(std::uint64_t seed, const RacerOptions& options) : options_(options), rng_(seed) {
  Rng draws = rng_;
  // A step and a measurement whose results are discarded throw if an option is out of range.
  (void)options.dynamics.noisyStep(getState(), 0, options.tau, options.noise, draws);
  (void)getObservation();
}

void Racer::setState(const Eigen::Vector4d& x) {
  requireFinite("racer: state", x);
  q = x.head<2>();
  v = x.tail<2>();
}

void Racer::stepDynamics(double u) {
  const Eigen::Vector4d next = options_.dynamics.noisyStep(getState(), u, options_.tau, options_.noise, rng_);
  q = next.head<2>();
  v = next.tail<2>();
}

void Racer::getDynamics(Eigen::MatrixXd& M, Eigen::VectorXd& F, Eigen::VectorXd& B) const {
  M = options_.dynamics.massMatrix(q);
  F = options_.dynamics.forces(q, v);
  B = options_.dynamics.controlDirection();
}

Eigen::Vector4d Racer::getObservation() const {
  return options_.sensors.measured(getState(), options_.dynamics.r);
}

Eigen::Matrix4d Racer::getObservationJacobian() const {
  return options_.sensors.jacobian(getState(), options_.dynamics.r);
}

}  // namespace rex

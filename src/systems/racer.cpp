#include "systems/racer.h"

#include "base/require.h"
#include "systems/normal_pair.h"
#include "systems/racer_kernel.h"

namespace rex {
namespace {

using internal::RacerNumbers;

RacerNumbers checked(const RacerDynamics& plant, const Eigen::Vector4d& x, double u) {
  requireFinite("racer: state", x);
  requireFinite("racer: control u", u);
  return internal::racerNumbers(plant);
}

internal::RacerState<double> stateOf(const Eigen::Vector4d& x) { return {x[0], x[1], x[2], x[3]}; }

}  // namespace

RacerNumbers internal::racerNumbers(const RacerDynamics& plant) {
  requirePositive("racer: radius r", plant.r);
  requirePositive("racer: length l", plant.l);
  requirePositive("racer: mass mA", plant.mA);
  requirePositive("racer: mass mB", plant.mB);
  requirePositive("racer: inertia IA", plant.IA);
  requirePositive("racer: inertia IB", plant.IB);
  requirePositive("racer: gravity g", plant.g);
  const double wheel = plant.mA + plant.IA / (plant.r * plant.r);  // its inertia as mB feels it
  const double inertiaTheta = plant.mB * plant.l * plant.l + plant.IB;
  return {.inertiaX = wheel + plant.mB,
          .inertiaTheta = inertiaTheta,
          .coupling = plant.mB * plant.l,
          .gravity = plant.g,
          .perRadius = 1 / plant.r,
          .leastDeterminant = wheel * inertiaTheta + plant.mB * plant.IB};
}

Eigen::Matrix2d RacerDynamics::massMatrix(const Eigen::Vector2d& q) const {
  requireFinite("racer: q", q);
  const RacerNumbers k = internal::racerNumbers(*this);
  const double mixed = k.coupling * sinCos(q[1]).cosine;
  return (Eigen::Matrix2d() << k.inertiaX, mixed, mixed, k.inertiaTheta).finished();
}

Eigen::Vector2d RacerDynamics::forces(const Eigen::Vector2d& q, const Eigen::Vector2d& v) const {
  requireFinite("racer: q", q);
  requireFinite("racer: velocities", v);
  const RacerNumbers k = internal::racerNumbers(*this);
  return -k.coupling * sinCos(q[1]).sine * Eigen::Vector2d(v[1] * v[1], k.gravity);
}

Eigen::Vector2d RacerDynamics::controlDirection() const {
  return {internal::racerNumbers(*this).perRadius, -1};
}

Eigen::Vector4d RacerDynamics::derivative(const Eigen::Vector4d& x, double u) const {
  const auto a = internal::racerAccelerations(checked(*this, x, u), x[1], x[3], u);
  return {x[2], x[3], a.x, a.theta};
}

// The accelerations are quotients with one denominator, the determinant of M.
LinearizedPlant RacerDynamics::linearized(const Eigen::Vector4d& x, double u) const {
  const RacerNumbers k = checked(*this, x, u);
  const auto [s, c] = sinCos(x[1]);
  const double w = x[3], mixed = k.coupling * c, swing = k.coupling * s;
  const double alongX = u * k.perRadius + swing * w * w, aboutAxis = swing * k.gravity - u;
  const double determinant = k.leastDeterminant + swing * swing, determinantByAngle = 2 * mixed * swing;
  const auto a = internal::racerAccelerations(k, x[1], w, u);

  LinearizedPlant linear;
  linear.A(0, 2) = linear.A(1, 3) = 1;
  linear.A(2, 1) = (k.inertiaTheta * mixed * w * w + swing * aboutAxis - mixed * mixed * k.gravity -
                    a.x * determinantByAngle) /
                   determinant;
  linear.A(3, 1) = (k.inertiaX * mixed * k.gravity + swing * alongX - mixed * mixed * w * w -
                    a.theta * determinantByAngle) /
                   determinant;
  linear.A(2, 3) = k.inertiaTheta * 2 * swing * w / determinant;
  linear.A(3, 3) = -mixed * 2 * swing * w / determinant;
  linear.B << 0, 0, (k.inertiaTheta * k.perRadius + mixed) / determinant,
      -(k.inertiaX + mixed * k.perRadius) / determinant;
  return linear;
}

double RacerDynamics::energy(const Eigen::Vector4d& x) const {
  requireFinite("racer: state", x);
  const Eigen::Vector2d q = x.head<2>(), v = x.tail<2>();
  const Eigen::Matrix<double, 3, 2> at = poses(q);
  return v.dot(massMatrix(q) * v) / 2 + g * (mA * at(1, 0) + mB * at(1, 1));
}

Eigen::Matrix<double, 3, 2> RacerDynamics::poses(const Eigen::Vector2d& q) const {
  requireFinite("racer: q", q);
  const double perRadius = internal::racerNumbers(*this).perRadius;
  const auto [s, c] = sinCos(q[1]);
  Eigen::Matrix<double, 3, 2> result;
  result.col(0) << q[0], r, q[0] * perRadius;
  result.col(1) << q[0] + l * s, r + l * c, q[1];
  return result;
}

Eigen::Vector4d RacerDynamics::rungeKuttaStep(const Eigen::Vector4d& x, double u, double tau) const {
  requirePositive("racer: time step tau", tau);
  const auto next = internal::racerStep(checked(*this, x, u), stateOf(x), u, tau);
  return {next.x, next.theta, next.v, next.w};
}

Eigen::Vector4d RacerDynamics::noisyStep(const Eigen::Vector4d& x, double u, double tau, double noise,
                                         Rng& rng) const {
  requireNotNegative("racer: noise", noise);
  Eigen::Vector4d next = rungeKuttaStep(x, u, tau);
  const auto normals = internal::normalPair(rng);
  const double deviation = squareRoot(tau) * noise;
  next[2] += deviation * normals.first;
  next[3] += deviation * normals.second;
  return next;
}

internal::RacerSensorNumbers internal::racerSensorNumbers(const RacerSensors& sensors, double r) {
  requirePositive("racer: radius r", r);
  requireFinite("racer: sensor constant s", sensors.s);
  requireFinite("racer: sensor constant phi", sensors.phi);
  requireFinite("racer: sensor constant kappa", sensors.kappa);
  requireFinite("racer: bias of the gyroscope", sensors.gyroBias);
  const auto [sine, cosine] = sinCos(sensors.phi);
  return {.scaledCosPhi = sensors.s * cosine,
          .scaledSinPhi = sensors.s * sine,
          .kappaCosPhi = sensors.kappa * cosine,
          .kappaSinPhi = sensors.kappa * sine,
          .gyroBias = sensors.gyroBias,
          .perRadius = 1 / r};
}

Eigen::Vector4d RacerSensors::measured(const Eigen::Vector4d& x, double r) const {
  requireFinite("racer: state", x);
  double y[internal::kRacerSensors];
  internal::racerMeasure(internal::racerSensorNumbers(*this, r),
                         internal::RacerState<double>{x[0], x[1], x[2], x[3]}, y);
  return Eigen::Map<const Eigen::Vector4d>(y);
}

Eigen::Matrix4d RacerSensors::jacobian(const Eigen::Vector4d& x, double r) const {
  requireFinite("racer: state", x);
  const internal::RacerSensorNumbers k = internal::racerSensorNumbers(*this, r);
  const auto [sine, cosine] = sinCos(x[1]);
  Eigen::Matrix4d J = Eigen::Matrix4d::Zero();
  J.row(0) << 0, -k.scaledCosPhi * sine - k.scaledSinPhi * cosine, 0, -2 * k.kappaCosPhi * x[3];
  J.row(1) << 0, k.scaledCosPhi * cosine - k.scaledSinPhi * sine, 0, -2 * k.kappaSinPhi * x[3];
  J(2, 3) = 1;
  J.row(3) << k.perRadius, -1, 0, 0;
  return J;
}

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

#include "course/car_simulator.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "estimation/landmark_sensor.h"
#include "geometry/rotation.h"
#include "systems/car.h"

namespace rex {
namespace {

constexpr double kLandmarkDeviation = 10;  // of each coordinate
constexpr std::uint64_t kPlaceStream = 0, kNoiseStream = 1;

void requireOptions(const CarOptions& options) {
  requirePositive("car: tau", options.tau, kSeconds);
  requirePositive("car: wheelbase", options.wheelbase, kMetres);
  for (const double noise : {options.dynamicsNoise, options.observationNoise, options.bearingNoise})
    requireNotNegative("car: noise", noise);
  requirePositiveOrInfinite("car: largest range", options.maxRange, kMetres);
  requirePositive("car: field of view", options.fieldOfView, kRadians);
}

void requireNumbers(const char* what, const Eigen::VectorXd& numbers, Eigen::Index size) {
  requireSize(what, numbers.size(), size);
  requireFinite(what, numbers);
}

LandmarkSensor sensorOf(const CarOptions& options) {
  return {.kind =
              options.rangeBearing ? LandmarkSensor::Kind::kRangeBearing : LandmarkSensor::Kind::kCartesian};
}

}  // namespace

bool isInView(const CarOptions& options, const Eigen::Vector3d& x, const Eigen::Vector2d& landmark) {
  const Eigen::Vector2d d = landmark - x.head<2>();
  // At the car itself any direction will do, as there is no bearing.
  const double bearing = d.isZero(0) ? 0 : wrapAngle(std::atan2(d[1], d[0]) - x[2]);
  return d.norm() <= options.maxRange && 2 * std::abs(bearing) <= options.fieldOfView;
}

CarSimulator::CarSimulator(std::uint64_t seed, int landmarks, const CarOptions& options)
    : options_(options), state_(Eigen::Vector3d::Zero()), rng_(Rng(seed).split(kNoiseStream)) {
  requireOptions(options);
  requireCount("car: landmarks", landmarks, 0);
  landmarks_.resize(2, landmarks);
  Rng places = Rng(seed).split(kPlaceStream);
  for (auto landmark : landmarks_.colwise()) landmark = kLandmarkDeviation * places.normalVector(2);
}

CarSimulator::CarSimulator(const Eigen::Matrix2Xd& landmarks, const CarOptions& options) : options_(options) {
  requireOptions(options);
  setLandmarks(landmarks);
}

CarSimulator CarSimulator::withoutPlaces(int landmarks, const CarOptions& options) {
  requireCount("car: landmarks", landmarks, 0);
  CarSimulator car(Eigen::Matrix2Xd::Zero(2, landmarks), options);
  car.hasPlaces_ = false;
  return car;
}

const Eigen::Matrix2Xd& CarSimulator::getLandmarks() const {
  requirePlaces("getLandmarks");
  return landmarks_;
}

void CarSimulator::setLandmarks(const Eigen::Matrix2Xd& landmarks) {
  requireFinite("landmarks", landmarks.reshaped());
  landmarks_ = landmarks;
  hasPlaces_ = true;
}

void CarSimulator::requirePlaces(const char* method) const {
  if (!hasPlaces_)
    throw Error({.what = fmt::format("CarSimulator::{}", method),
                 .found = "landmarks whose positions are not known here",
                 .wanted = "the method that is given landmarks"});
}

void CarSimulator::requireTruth(const char* method) const {
  if (!state_)
    throw Error({.what = fmt::format("CarSimulator::{}", method),
                 .found = "a car whose true state is not known here",
                 .wanted = "the observations that your function is given"});
}

Eigen::Vector3d CarSimulator::getState() const {
  requireTruth("getState");
  return *state_;
}

void CarSimulator::setState(const Eigen::VectorXd& x) {
  requireNumbers("state", x, 3);
  requireTruth("setState");
  state_ = x;
}

Eigen::VectorXd CarSimulator::getMeanStateAfterStep(const Eigen::VectorXd& x,
                                                    const Eigen::VectorXd& u) const {
  requireNumbers("state", x, 3);
  requireNumbers("control", u, 2);
  return eulerStepCar({.wheelbase = options_.wheelbase}, x, u, options_.tau);
}

Eigen::MatrixXd CarSimulator::getStateJacobian(const Eigen::VectorXd& x, const Eigen::VectorXd& u) const {
  requireNumbers("state", x, 3);
  requireNumbers("control", u, 2);
  Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
  A(0, 2) = -options_.tau * u[0] * std::sin(x[2]);
  A(1, 2) = options_.tau * u[0] * std::cos(x[2]);
  return A;
}

void CarSimulator::step(const Eigen::VectorXd& u) {
  requireTruth("step");
  state_ = getMeanStateAfterStep(*state_, u) + options_.dynamicsNoise * rng_.normalVector(3);
}

Eigen::VectorXd CarSimulator::getRealNoisyObservation() {
  requireTruth("getRealNoisyObservation");
  Eigen::VectorXd y = getMeanObservationAtState(*state_);
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const bool isBearing = options_.rangeBearing && i % 2 == 1;
    y[i] += (isBearing ? options_.bearingNoise : options_.observationNoise) * rng_.normal();
    if (isBearing) y[i] = wrapAngle(y[i]);
  }
  return y;
}

std::vector<int> CarSimulator::getVisibleLandmarks() const {
  requireTruth("getVisibleLandmarks");
  std::vector<int> visible;
  for (int i = 0; i < countLandmarks(); ++i)
    if (isInView(options_, *state_, landmarks_.col(i))) visible.push_back(i);
  return visible;
}

Eigen::VectorXd CarSimulator::getMeanObservationAtState(const Eigen::VectorXd& x) const {
  requirePlaces("getMeanObservationAtState");
  return getMeanObservationAtStateAndLandmarks(x, landmarks_.reshaped());
}

Eigen::MatrixXd CarSimulator::getObservationJacobianAtState(const Eigen::VectorXd& x) const {
  requirePlaces("getObservationJacobianAtState");
  return getObservationJacobianAtStateAndLandmarks(x, landmarks_.reshaped()).leftCols<3>();
}

void CarSimulator::getLinearObservationModelAtState(Eigen::MatrixXd& C, Eigen::VectorXd& c,
                                                    const Eigen::VectorXd& x) const {
  requireNumbers("state", x, 3);
  if (options_.rangeBearing)
    throw Error({.what = "CarSimulator::getLinearObservationModelAtState",
                 .found = "a car that observes distances and bearings",
                 .wanted = "one that observes (ahead, left), which is linear in the landmarks"});
  const LandmarkView view = landmarkView(sensorOf(options_), x, {0, 0});
  C = Eigen::MatrixXd::Zero(landmarks_.size(), landmarks_.size());
  for (Eigen::Index i = 0; i < C.rows(); i += 2) C.block<2, 2>(i, i) = view.Jl;
  c = view.y.replicate(countLandmarks(), 1);
}

Eigen::VectorXd CarSimulator::getMeanObservationAtStateAndLandmarks(const Eigen::VectorXd& x,
                                                                    const Eigen::VectorXd& landmarks) const {
  requireNumbers("state", x, 3);
  requireNumbers("landmarks", landmarks, landmarks_.size());
  Eigen::VectorXd y(landmarks.size());
  for (Eigen::Index i = 0; i < landmarks.size(); i += 2)
    y.segment<2>(i) = landmarkView(sensorOf(options_), x, landmarks.segment<2>(i)).y;
  return y;
}

Eigen::MatrixXd CarSimulator::getObservationJacobianAtStateAndLandmarks(
    const Eigen::VectorXd& x, const Eigen::VectorXd& landmarks) const {
  requireNumbers("state", x, 3);
  requireNumbers("landmarks", landmarks, landmarks_.size());
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(landmarks.size(), 3 + landmarks.size());
  for (Eigen::Index i = 0; i < landmarks.size(); i += 2) {
    const LandmarkView view = landmarkView(sensorOf(options_), x, landmarks.segment<2>(i));
    J.block<2, 3>(i, 0) = view.Jx;
    J.block<2, 2>(i, 3 + i) = view.Jl;
  }
  return J;
}

}  // namespace rex

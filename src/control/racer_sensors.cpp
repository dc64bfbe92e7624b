#include "control/racer_sensors.h"

#include "control/racer_kernel_internal.h"
#include "control/racer_numbers_internal.h"
#include "control/require_internal.h"

namespace rex {

internal::RacerSensorNumbers internal::racerSensorNumbers(const RacerSensors& sensors, double r) {
  requirePositive("racer: radius r", r);
  rex::requireFinite("racer: sensor constant s", sensors.s);
  rex::requireFinite("racer: sensor constant phi", sensors.phi);
  rex::requireFinite("racer: sensor constant kappa", sensors.kappa);
  rex::requireFinite("racer: bias of the gyroscope", sensors.gyroBias);
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

}  // namespace rex

#pragma once

#include "systems/car.h"
#include "systems/motion_model.h"

namespace rex {

/// The noise of a base that rolls.
struct BaseNoise {
  /// How far a control u is from what was meant: the integral of its error over time has the variance
  /// travel^2 times the integral of |u|, as wheels slip more the more they turn (Siegwart and Nourbakhsh,
  /// Introduction to autonomous mobile robots, 2004, eq. 5.8).
  double travel = 0.02;
  Eigen::Vector3d drift{0.01, 0.01, 0.01};  ///< deviations of x, y (m) and heading after a second
};

/// The twist (vx, vy, w) of a base in its own frame, m/s and rad/s, for controls u, and its Jacobian.
struct BaseTwist {
  int controls = 0;
  std::function<Eigen::Vector3d(const VectorArg& u)> value{};
  std::function<Eigen::MatrixXd(const VectorArg& u)> jacobian{};  ///< 3 x controls
};

/// The motion of a base with that twist, x = (x, y, heading): exact, along an arc; the heading is not
/// wrapped. Sola et al. 2018, eq. (156). Throws Error for a twist without functions, and negative noise.
[[nodiscard]] MotionModel planarMotion(const BaseTwist& twist, const BaseNoise& noise = {});

/// Two driven wheels on one axle. u = (left, right), the speeds of the wheels, rad/s.
struct DifferentialDrive {
  double wheelRadius = 0.05, track = 0.3;  ///< metres; the track is the distance between the wheels
};
/// Three wheels with rollers at 60, 180 and 300 degrees from the heading, whose axles point to the centre.
/// They drive the base in any direction while it turns. u: their speeds, rad/s, positive wheels turn the base
/// to the left.
struct OmnidirectionalBase {
  double wheelRadius = 0.05,
         reach = 0.2;  ///< metres; the reach is the distance of the wheels from the centre
};
/// A base with u = (speed, turning rate) on loose ground: it drives slower than its wheels, and drifts to the
/// outside of its turns with a speed proportional to the centripetal acceleration.
struct SlippingUnicycle {
  double slip = 0.1;   ///< the part of the speed that is lost, from 0 to below 1
  double drift = 0.1;  ///< seconds; sideways speed per centripetal acceleration
};

/// Their motions, exact for controls that are constant. Throw Error for lengths that are not positive, a slip
/// out of range, and as planarMotion. Cars steer as far as u says.
[[nodiscard]] MotionModel motionModel(const DifferentialDrive& base, const BaseNoise& noise = {});
[[nodiscard]] MotionModel motionModel(const OmnidirectionalBase& base, const BaseNoise& noise = {});
[[nodiscard]] MotionModel motionModel(const SlippingUnicycle& base, const BaseNoise& noise = {});
[[nodiscard]] MotionModel motionModel(const Car& car, const BaseNoise& noise = {});
/// Its trailer drifts as its car does.
[[nodiscard]] MotionModel motionModel(const CarWithTrailer& rig, const BaseNoise& noise = {});

}  // namespace rex

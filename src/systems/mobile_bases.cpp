#include "systems/mobile_bases.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

// sin(a) / a and its derivative, for small a by their series.
double sinc(double a) { return std::abs(a) < 1e-2 ? 1 - a * a / 6 * (1 - a * a / 20) : std::sin(a) / a; }
double sincSlope(double a) {
  return std::abs(a) < 1e-2 ? -a / 3 * (1 - a * a / 10 * (1 - a * a / 28))
                            : (a * std::cos(a) - std::sin(a)) / (a * a);
}

Eigen::Vector2d turned(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

// The pose after driving `way`, a twist times its time: along a chord in the mean direction.
Eigen::Vector3d along(const Eigen::Vector3d& pose, const Eigen::Vector3d& way) {
  const double half = way[2] / 2;
  Eigen::Vector3d end;
  end << pose.head<2>() + sinc(half) * (Eigen::Rotation2Dd(pose[2] + half) * way.head<2>()), pose[2] + way[2];
  return end;
}

Eigen::Matrix3d slopeByWay(const Eigen::Vector3d& pose, const Eigen::Vector3d& way) {
  const double half = way[2] / 2;
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(pose[2] + half).toRotationMatrix();
  const Eigen::Vector2d chord = R * way.head<2>();
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
  J.topLeftCorner<2, 2>() = sinc(half) * R;
  J.topRightCorner<2, 1>() = (sincSlope(half) * chord + sinc(half) * turned(chord)) / 2;
  return J;
}

// The noise of wheels and drift, for a state that begins with a pose; what follows are headings.
Eigen::MatrixXd noiseOf(const BaseNoise& noise, const Eigen::MatrixXd& B, const VectorArg& u, double dt) {
  Eigen::VectorXd drift = Eigen::VectorXd::Constant(B.rows(), noise.drift[2]);
  drift.head<3>() = noise.drift;
  Eigen::MatrixXd Q = (dt * drift.cwiseAbs2()).asDiagonal();
  if (dt == 0) return Q;
  // An error of travel e, of variance travel^2 |u| dt, is an error e / dt of u.
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const Eigen::VectorXd column = B.col(i);
    Q += noise.travel * noise.travel * std::abs(u[i]) / dt * column * column.transpose();
  }
  return Q;
}

void requireNoise(const BaseNoise& noise) {
  requireNotNegative("noise of travel", noise.travel);
  requireNotNegative("drift of a base", noise.drift);
}

BaseTwist twistOf(const Car& car) {
  requirePositive("wheelbase of a car", car.wheelbase, kMetres);
  const double L = car.wheelbase;
  return {2, [L](const VectorArg& u) { return Eigen::Vector3d(u[0], 0, u[0] / L * std::tan(u[1])); },
          [L](const VectorArg& u) -> Eigen::MatrixXd {
            const double tangent = std::tan(u[1]);
            Eigen::Matrix<double, 3, 2> J;
            J << 1, 0, 0, 0, tangent / L, u[0] / L * (1 + tangent * tangent);
            return J;
          }};
}

}  // namespace

MotionModel planarMotion(const BaseTwist& twist, const BaseNoise& noise) {
  if (!twist.value || !twist.jacobian)
    throw Error({.what = "twist of a base", .found = "no function", .wanted = "its value and its Jacobian"});
  requireNoise(noise);
  MotionModel model{.states = 3, .controls = twist.controls};
  model.f = [twist](const VectorArg& x, const VectorArg& u, double dt) -> Eigen::VectorXd {
    return along(x, dt * twist.value(u));
  };
  model.A = [twist](const VectorArg& x, const VectorArg& u, double dt) -> Eigen::MatrixXd {
    Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
    A.topRightCorner<2, 1>() = turned((along(x, dt * twist.value(u)) - x).head<2>());
    return A;
  };
  model.B = [twist](const VectorArg& x, const VectorArg& u, double dt) -> Eigen::MatrixXd {
    const Eigen::MatrixXd byControls = dt * twist.jacobian(u);
    return slopeByWay(x, dt * twist.value(u)) * byControls;
  };
  model.noise = [noise, B = model.B](const VectorArg& x, const VectorArg& u, double dt) {
    return noiseOf(noise, B(x, u, dt), u, dt);
  };
  return model;
}

MotionModel motionModel(const DifferentialDrive& base, const BaseNoise& noise) {
  requirePositive("radius of wheels", base.wheelRadius, kMetres);
  requirePositive("track of a differential drive", base.track, kMetres);
  const double r = base.wheelRadius;
  Eigen::MatrixXd T(3, 2);
  T << r / 2, r / 2, 0, 0, -r / base.track, r / base.track;
  return planarMotion(
      {2, [T](const VectorArg& u) -> Eigen::Vector3d { return T * u; }, [T](const VectorArg&) { return T; }},
      noise);
}

MotionModel motionModel(const OmnidirectionalBase& base, const BaseNoise& noise) {
  requirePositive("radius of wheels", base.wheelRadius, kMetres);
  requirePositive("reach of an omnidirectional base", base.reach, kMetres);
  // Each wheel rolls across the direction in which it lies, and along it its rollers turn: its speed is
  // -sin(a) vx + cos(a) vy + reach w. The three rows are orthogonal, which inverts them.
  Eigen::MatrixXd T(3, 3);
  for (int i = 0; i < 3; ++i) {
    const double a = (60 + 120 * i) * std::numbers::pi / 180;
    T.col(i) = base.wheelRadius / 3 * Eigen::Vector3d(-2 * std::sin(a), 2 * std::cos(a), 1 / base.reach);
  }
  return planarMotion(
      {3, [T](const VectorArg& u) -> Eigen::Vector3d { return T * u; }, [T](const VectorArg&) { return T; }},
      noise);
}

MotionModel motionModel(const SlippingUnicycle& base, const BaseNoise& noise) {
  requireNotNegative("drift of a slipping base", base.drift, kSeconds);
  if (!(base.slip >= 0 && base.slip < 1))
    throw Error({.what = "slip of a base",
                 .found = fmt::format("{:g}", base.slip),
                 .wanted = "a number from 0 to below 1"});
  const double kept = 1 - base.slip, drift = base.drift;
  return planarMotion(
      {2, [=](const VectorArg& u) { return Eigen::Vector3d(kept * u[0], -drift * kept * u[0] * u[1], u[1]); },
       [=](const VectorArg& u) -> Eigen::MatrixXd {
         Eigen::Matrix<double, 3, 2> J;
         J << kept, 0, -drift * kept * u[1], -drift * kept * u[0], 0, 1;
         return J;
       }},
      noise);
}

MotionModel motionModel(const Car& car, const BaseNoise& noise) { return planarMotion(twistOf(car), noise); }

MotionModel motionModel(const CarWithTrailer& rig, const BaseNoise& noise) {
  requirePositive("hitch of a trailer", rig.hitchLength, kMetres);
  const MotionModel car = motionModel(rig.car, noise);
  const Hitch hitch{rig.hitchLength};
  const double L = rig.car.wheelbase;
  MotionModel model{.states = 4, .controls = 2};
  model.f = [=](const VectorArg& x, const VectorArg& u, double dt) -> Eigen::VectorXd {
    Eigen::VectorXd next(4);
    next.head<3>() = car.f(x.head<3>(), u, dt);
    next[3] = next[2] - hitch.angle(x[2] - x[3], std::tan(u[1]) / L, u[0] * dt);
    return next;
  };
  // The heading of the trailer is that of the car less the angle.
  model.A = [=](const VectorArg& x, const VectorArg& u, double dt) -> Eigen::MatrixXd {
    const double byAngle = hitch.slopes(x[2] - x[3], std::tan(u[1]) / L, u[0] * dt)[0];
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(4, 4);
    A.topLeftCorner<3, 3>() = car.A(x.head<3>(), u, dt);
    A.row(3) << 0, 0, 1 - byAngle, byAngle;
    return A;
  };
  model.B = [=](const VectorArg& x, const VectorArg& u, double dt) -> Eigen::MatrixXd {
    const double tangent = std::tan(u[1]);
    const Eigen::Vector3d by = hitch.slopes(x[2] - x[3], tangent / L, u[0] * dt);
    Eigen::MatrixXd B(4, 2);
    B.topRows<3>() = car.B(x.head<3>(), u, dt);
    B(3, 0) = B(2, 0) - by[2] * dt;
    B(3, 1) = B(2, 1) - by[1] * (1 + tangent * tangent) / L;
    return B;
  };
  model.noise = [noise, B = model.B](const VectorArg& x, const VectorArg& u, double dt) {
    return noiseOf(noise, B(x, u, dt), u, dt);
  };
  return model;
}

}  // namespace rex

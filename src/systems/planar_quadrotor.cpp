#include "systems/planar_quadrotor.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

constexpr int kQuadrotorStates = 6;

// Integrals from 0 to dt of a function of the time, of its product with the time that is left, and of more
// of these: a panel has five points of Gauss and Legendre and turns by at most a quarter of a radian.
template <class Add>
void overTime(double dt, double turn, const Add& add) {
  constexpr double kPoints[] = {0, .5384693101056831, -.5384693101056831, .9061798459386640,
                                -.9061798459386640};
  constexpr double kWeights[] = {.5688888888888889, .4786286704993665, .4786286704993665, .2369268850561891,
                                 .2369268850561891};
  const int panels = std::max(1, static_cast<int>(std::ceil(std::min(1e6, 4 * turn))));
  const double half = dt / panels / 2;
  for (int i = 0; i < panels; ++i)
    for (int k = 0; k < 5; ++k) add((2 * i + 1 + kPoints[k]) * half, kWeights[k] * half);
}

// The angular acceleration, and how far it turns at most.
struct Pitching {
  double rate, acceleration, dt;
  double angle(double t) const { return t * (rate + t * acceleration / 2); }
  double most() const { return std::abs(rate * dt) + std::abs(acceleration) * dt * dt / 2; }
};

Pitching pitchingOf(const PlanarQuadrotor& quadrotor, const VectorArg& x, const VectorArg& u, double dt) {
  return {x[5], quadrotor.arm * (u[1] - u[0]) / quadrotor.inertia, dt};
}

Eigen::VectorXd flown(const PlanarQuadrotor& quadrotor, const VectorArg& x, const VectorArg& u, double dt) {
  const Pitching pitching = pitchingOf(quadrotor, x, u, dt);
  const double lift = (u[0] + u[1]) / quadrotor.mass;
  Eigen::Vector2d p = x.head<2>() + dt * x.segment<2>(3), v = x.segment<2>(3);
  p[1] -= quadrotor.gravity * dt * dt / 2;
  v[1] -= quadrotor.gravity * dt;
  overTime(dt, pitching.most(), [&](double t, double weight) {
    const double pitch = x[2] + pitching.angle(t);
    const Eigen::Vector2d push = weight * lift * Eigen::Vector2d(-std::sin(pitch), std::cos(pitch));
    v += push;
    p += (dt - t) * push;
  });
  Eigen::VectorXd next(kQuadrotorStates);
  next << p, x[2] + pitching.angle(dt), v, x[5] + dt * pitching.acceleration;
  return next;
}

// Its derivatives by x and u, side by side.
Eigen::MatrixXd slopes(const PlanarQuadrotor& quadrotor, const VectorArg& x, const VectorArg& u, double dt) {
  const Pitching pitching = pitchingOf(quadrotor, x, u, dt);
  const double lift = (u[0] + u[1]) / quadrotor.mass, turn = quadrotor.arm / quadrotor.inertia;
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(kQuadrotorStates, kQuadrotorStates + 2);
  J.leftCols(kQuadrotorStates).setIdentity();
  J(0, 3) = J(1, 4) = J(2, 5) = dt;
  J(2, 6) = -turn * dt * dt / 2;
  J(5, 6) = -turn * dt;
  overTime(dt, pitching.most(), [&](double t, double weight) {
    const double pitch = x[2] + pitching.angle(t), c = std::cos(pitch), s = std::sin(pitch);
    const Eigen::Vector2d up = weight / quadrotor.mass * Eigen::Vector2d(-s, c),
                          turned = weight * lift * Eigen::Vector2d(-c, -s);
    const auto add = [&](Eigen::Index column, const Eigen::Vector2d& push) {
      J.block<2, 1>(3, column) += push;
      J.block<2, 1>(0, column) += (dt - t) * push;
    };
    add(2, turned);
    add(5, t * turned);
    add(6, up - turn * t * t / 2 * turned);
    add(7, up + turn * t * t / 2 * turned);
  });
  J(2, 7) = -J(2, 6);
  J(5, 7) = -J(5, 6);
  return J;
}

}  // namespace

MotionModel motionModel(const PlanarQuadrotor& quadrotor) {
  requirePositive("mass of a quadrotor", quadrotor.mass);
  requirePositive("inertia of a quadrotor", quadrotor.inertia);
  requirePositive("arm of a quadrotor", quadrotor.arm, kMetres);
  requireNotNegative("gust", quadrotor.gust);
  requireNotNegative("tumble", quadrotor.tumble);
  MotionModel model{.states = kQuadrotorStates, .controls = 2};
  model.f = [quadrotor](const VectorArg& x, const VectorArg& u, double dt) {
    return flown(quadrotor, x, u, dt);
  };
  model.A = [quadrotor](const VectorArg& x, const VectorArg& u, double dt) -> Eigen::MatrixXd {
    return slopes(quadrotor, x, u, dt).leftCols(kQuadrotorStates);
  };
  model.B = [quadrotor](const VectorArg& x, const VectorArg& u, double dt) -> Eigen::MatrixXd {
    return slopes(quadrotor, x, u, dt).rightCols(2);
  };
  model.noise = [quadrotor](const VectorArg&, const VectorArg&, double dt) -> Eigen::MatrixXd {
    // White noise of the accelerations, integrated once and twice.
    Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(kQuadrotorStates, kQuadrotorStates);
    for (int i = 0; i < 3; ++i) {
      const double deviation = i < 2 ? quadrotor.gust : quadrotor.tumble, variance = deviation * deviation;
      Q(i, i) = variance * dt * dt * dt / 3;
      Q(i, i + 3) = Q(i + 3, i) = variance * dt * dt / 2;
      Q(i + 3, i + 3) = variance * dt;
    }
    return Q;
  };
  return model;
}

Eigen::Vector2d hoverThrusts(const PlanarQuadrotor& quadrotor) {
  return Eigen::Vector2d::Constant(quadrotor.mass * quadrotor.gravity / 2);
}

double totalEnergy(const PlanarQuadrotor& quadrotor, const VectorArg& x) {
  requireSize("state of a quadrotor", x.size(), kQuadrotorStates);
  return quadrotor.mass * (x.segment<2>(3).squaredNorm() / 2 + quadrotor.gravity * x[1]) +
         quadrotor.inertia * x[5] * x[5] / 2;
}

}  // namespace rex

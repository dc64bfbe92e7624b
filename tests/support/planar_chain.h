#pragma once

#include <cmath>
#include <string>

#include <Eigen/LU>

#include "scene/scene_spec.h"

namespace rex {

/// Three equal cylinders, 1 m, 1 kg, 5 cm thick, that hang on one another by hinges about -y; all lie along x
/// at q = 0, and turn upwards with q.
inline SceneSpec swingScene() {
  constexpr double kRadius = 0.05, kAcross = 1. / 12 + kRadius * kRadius / 4;
  SceneSpec spec{.name = "swing", .bodies = {}, .joints = {}, .worldShapes = {}};
  for (int i = 0; i < 3; ++i) {
    BodySpec link{.name = "link" + std::to_string(i), .X_WB = {}, .mass = 1};
    link.p_BBcm = {0.5, 0, 0};
    link.inertia = Eigen::Vector3d(kRadius * kRadius / 2, kAcross, kAcross).asDiagonal();
    JointSpec joint{
        .name = "hinge" + std::to_string(i), .parent = "world", .child = link.name, .X_PF = {}, .X_MC = {}};
    joint.axis = -Eigen::Vector3d::UnitY();
    if (i > 0) {
      joint.parent = spec.bodies.back().name;
      joint.X_PF.p = {1, 0, 0};
    }
    spec.bodies.push_back(link);
    spec.joints.push_back(joint);
  }
  return spec;
}

/// Its motion in closed form, by Lagrange, in the angles of the links above the horizontal: the sum of
/// C_ij cos(t_i - t_j) w_j' + C_ij sin(t_i - t_j) w_j^2 over j is -g k_i cos t_i.
struct PlanarChain {
  using Vector6 = Eigen::Matrix<double, 6, 1>;  // angles, then their speeds
  static constexpr double kGravity = 9.81;
  /// Of the energies of links at the height of their full length, J: the unit of drift.
  static constexpr double kEnergyScale = 44.145;

  static Eigen::Matrix3d coupling() {
    constexpr double kAtEnd = 1. / 12 + 0.05 * 0.05 / 4 + 0.25;
    Eigen::Matrix3d C;
    C << kAtEnd + 2, 1.5, 0.5, 1.5, kAtEnd + 1, 0.5, 0.5, 0.5, kAtEnd;
    return C;
  }
  static Eigen::Vector3d levers() { return {2.5, 1.5, 0.5}; }

  static Vector6 derivative(const Vector6& x) {
    const Eigen::Matrix3d C = coupling();
    const Eigen::Vector3d angle = x.head<3>(), speed = x.tail<3>();
    Eigen::Matrix3d M;
    Eigen::Vector3d force = -kGravity * levers().cwiseProduct(angle.array().cos().matrix());
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        M(i, j) = C(i, j) * std::cos(angle[i] - angle[j]);
        force[i] -= C(i, j) * std::sin(angle[i] - angle[j]) * speed[j] * speed[j];
      }
    }
    Vector6 dx;
    dx << speed, M.inverse() * force;
    return dx;
  }
};

/// Angles above the horizontal from joint angles: each link turns with those before it.
inline Eigen::Vector3d chainAngles(const Eigen::VectorXd& q) { return {q[0], q[0] + q[1], q.sum()}; }

}  // namespace rex

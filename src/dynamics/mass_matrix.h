#pragma once

#include "dynamics/inverse_dynamics.h"

namespace rex {

/// M(q), nv x nv, symmetric: kinetic energy is v^T M v / 2. By the composite-rigid-body algorithm;
/// Featherstone, Rigid Body Dynamics Algorithms, table 6.2. Throws as inverseDynamics.
[[nodiscard]] Eigen::MatrixXd massMatrix(const Model& model, const VectorArg& q);
/// Overload for hot loops. The caller owns M, which must be nv x nv already.
void massMatrix(const Model& model, const VectorArg& q, DynamicsWorkspace& workspace,
                Eigen::Ref<Eigen::MatrixXd> M);

/// M and F of M(q) a + F(q, v) = u. Slide 3:28.
struct EquationOfMotion {
  Eigen::MatrixXd M;
  Eigen::VectorXd F;
};
[[nodiscard]] EquationOfMotion equationOfMotion(const Model& model, const VectorArg& q, const VectorArg& v,
                                                const Eigen::Vector3d& gravity_W = earthGravity());
/// Overload for hot loops. Resizes M and F, which allocates at most once.
void equationOfMotion(const Model& model, const VectorArg& q, const VectorArg& v,
                      const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace, EquationOfMotion& out);

}  // namespace rex

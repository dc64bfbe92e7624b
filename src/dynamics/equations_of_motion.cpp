#include "dynamics/equations_of_motion.h"

#include <algorithm>

#include "base/cpu_lanes.h"
#include "base/error.h"
#include "base/require.h"
#include "dynamics/kernel_room_internal.h"
#include "dynamics/kernels_internal.h"
#include "dynamics/requirements_internal.h"
#include "dynamics/spatial_internal.h"
#include "geometry/rotation.h"

namespace rex {

void massMatrix(const Model& model, const VectorArg& q, DynamicsWorkspace& workspace,
                Eigen::Ref<Eigen::MatrixXd> M) {
  internal::requirePositions(model, q);
  requireSize("rows of the mass matrix M", M.rows(), model.nv());
  requireSize("columns of the mass matrix M", M.cols(), model.nv());
  const auto kernel = kernelFor<internal::MassMatrixKernel>(cpuLanes());
  kernel.one(model.links().data(), static_cast<int>(model.links().size()), q.data(),
             internal::roomFor(kernel, model, 1, workspace), M.data(), M.outerStride(), model.nv());
  M.diagonal() += model.armature();
}

Eigen::MatrixXd massMatrix(const Model& model, const VectorArg& q) {
  DynamicsWorkspace workspace;
  Eigen::MatrixXd M(model.nv(), model.nv());
  massMatrix(model, q, workspace, M);
  return M;
}

EquationOfMotion equationOfMotion(const Model& model, const VectorArg& q, const VectorArg& v,
                                  const Eigen::Vector3d& gravity_W) {
  DynamicsWorkspace workspace;
  EquationOfMotion motion;
  equationOfMotion(model, q, v, gravity_W, workspace, motion);
  return motion;
}

void equationOfMotion(const Model& model, const VectorArg& q, const VectorArg& v,
                      const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace, EquationOfMotion& out) {
  out.M.resize(model.nv(), model.nv());
  out.F.resize(model.nv());
  massMatrix(model, q, workspace, out.M);
  biasForces(model, q, v, gravity_W, workspace, out.F);
}

namespace {

using internal::Matrix6d;

// Spatial inertia I, and B with B V = V x* I V and dI/dt = B + B^T, of a body and everything it carries.
struct Composite {
  Matrix6d I = Matrix6d::Zero(), B = Matrix6d::Zero();

  void add(const Composite& other) { I += other.I, B += other.B; }
};

Matrix6d blocks(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, const Eigen::Matrix3d& c,
                const Eigen::Matrix3d& d) {
  Matrix6d m;
  m << a, b, c, d;
  return m;
}

Composite ofBody(const Body& body, const Pose& X_WB, const Vector6d& V) {
  const Eigen::Matrix3d zero = Eigen::Matrix3d::Zero();
  const internal::MassInWorld mass(body, X_WB);
  const Eigen::Matrix3d v = skew(V.head<3>()), w = skew(V.tail<3>());
  const Vector6d h = mass.momentum(V);
  Composite of;
  of.I = mass.spatialInertia();
  const Matrix6d crossMotion = blocks(w, v, zero, w), crossForce = blocks(w, zero, v, w);
  // Maps a twist W to W x* h.
  const Matrix6d crossMomentum = blocks(zero, -skew(h.head<3>()), -skew(h.head<3>()), -skew(h.tail<3>()));
  of.B = (crossForce * of.I - of.I * crossMotion + crossMomentum) / 2;
  return of;
}

// A freedom: its column in v, its twist and the rate of that twist.
struct Freedom {
  int column;
  Vector6d s, rate;
};

// The freedoms of the joint into each body.
std::vector<std::vector<Freedom>> freedoms(const Model& model, const BodyPoses& poses,
                                           const std::vector<Vector6d>& V) {
  std::vector<std::vector<Freedom>> all(V.size());
  for (int i = 1; i < static_cast<int>(V.size()); ++i) {
    const auto append = [&](int column, const Joint& joint, const DegreeOfFreedom& freedom) {
      const Vector6d s = internal::freedomTwist(joint, freedom, poses);
      const Vector6d rate = internal::freedomTwistRate(joint, freedom, s, V);
      all[static_cast<std::size_t>(i)].push_back({column, s, rate});
    };
    internal::forEachFreedomOf(model, BodyId{i}, append);
  }
  return all;
}

}  // namespace

Eigen::MatrixXd coriolisMatrix(const Model& model, const VectorArg& q, const VectorArg& v) {
  requireSize("joint velocities v", v.size(), model.nv());
  const BodyPoses poses = forwardKinematics(model, q);
  const std::vector<Vector6d> V = internal::bodyTwists(model, poses, v);
  const std::vector<std::vector<Freedom>> of = freedoms(model, poses, V);
  std::vector<Composite> composites(V.size());
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(model.nv(), model.nv());
  // C = sum over bodies of J^T (I dJ/dt + B J), added up over the pairs of freedoms above each body.
  for (int i = static_cast<int>(V.size()) - 1; i > 0; --i) {
    const BodyId body{i};
    Composite& composite = composites[static_cast<std::size_t>(i)];
    composite.add(ofBody(model[body], poses[body], V[static_cast<std::size_t>(i)]));
    composites[static_cast<std::size_t>(model[body].parent)].add(composite);
    for (const Freedom& own : of[static_cast<std::size_t>(i)]) {
      const Vector6d force = composite.I * own.rate + composite.B * own.s;
      const Vector6d momentum = composite.I * own.s, turned = composite.B.transpose() * own.s;
      for (const Freedom& beside : of[static_cast<std::size_t>(i)])
        C(beside.column, own.column) += beside.s.dot(force);
      for (BodyId at = model[body].parent; at != kWorld; at = model[at].parent) {
        for (const Freedom& above : of[static_cast<std::size_t>(at)]) {
          C(above.column, own.column) += above.s.dot(force);
          C(own.column, above.column) += above.rate.dot(momentum) + above.s.dot(turned);
        }
      }
    }
  }
  return C;
}

namespace {

// The step size for functions that change over one unit; twice or half of it gives larger errors.
constexpr double kStep = 1. / 32;

// f'(0) by central differences of eighth order.
template <class Function>
double derivative(const Function& f, double step) {
  constexpr double kWeights[] = {4. / 5, -1. / 5, 4. / 105, -1. / 280};
  double sum = 0;
  for (int i = 0; i < 4; ++i) sum += kWeights[i] * (f((i + 1) * step) - f(-(i + 1) * step));
  return sum / step;
}

template <class Function>
double partialDerivative(const Function& f, Eigen::VectorXd at, Eigen::Index i) {
  const double x = at[i];
  return derivative(
      [&](double by) {
        at[i] = x + by;
        return f(at);
      },
      kStep);
}

}  // namespace

Eigen::VectorXd eulerLagrangeForce(const Lagrangian& L, const VectorArg& q, const VectorArg& v,
                                   const VectorArg& a) {
  requireSize("velocities v", v.size(), q.size());
  requireSize("accelerations a", a.size(), q.size());
  const auto value = [&](const Eigen::VectorXd& atQ, const Eigen::VectorXd& atV) {
    const double energy = L(atQ, atV);
    requireFinite("Lagrangian", energy);
    return energy;
  };
  // In that time neither q nor v changes by more than a step.
  const double speed = std::max({1., v.lpNorm<Eigen::Infinity>(), a.lpNorm<Eigen::Infinity>()});
  Eigen::VectorXd u(q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const auto momentum = [&](double t) {
      const Eigen::VectorXd atQ = q + t * v + t * t / 2 * a;
      return partialDerivative([&](const Eigen::VectorXd& atV) { return value(atQ, atV); }, v + t * a, i);
    };
    const double push = partialDerivative([&](const Eigen::VectorXd& atQ) { return value(atQ, v); }, q, i);
    u[i] = derivative(momentum, kStep / speed) - push;
  }
  return u;
}

EquationOfMotion equationOfMotion(const Lagrangian& L, const VectorArg& q, const VectorArg& v) {
  const Eigen::Index n = q.size();
  EquationOfMotion motion{Eigen::MatrixXd(n, n), eulerLagrangeForce(L, q, v, Eigen::VectorXd::Zero(n))};
  for (Eigen::Index i = 0; i < n; ++i)
    motion.M.col(i) = eulerLagrangeForce(L, q, v, Eigen::VectorXd::Unit(n, i)) - motion.F;
  return motion;
}

}  // namespace rex

#include "dynamics/coriolis_matrix.h"

#include "base/error.h"
#include "dynamics/spatial_internal.h"
#include "geometry/rotation.h"

namespace rex {
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

}  // namespace rex

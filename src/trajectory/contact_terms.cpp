#include "trajectory/contact_terms.h"

#include <cmath>
#include <limits>
#include <utility>

#include "base/require.h"
#include "collision/motion_clearance.h"
#include "kinematics/jacobians.h"
#include "trajectory/robot_window_internal.h"

namespace rex {
namespace {

void requireSound(const Model& model, const ContactSampling& sampling) {
  internal::requirePlain(model);
  requirePositive("margin of a contact term", sampling.margin, kMetres);
  requireCount("samples of a contact term", sampling.samples, 1);
}

// A task map in several postures between two.
class SampledMap {
 public:
  SampledMap(const Model& model, TaskMap map, int samples, double weight)
      : posture_(model), map_(std::move(map)), samples_(samples), weight_(weight) {}

  void operator()(const TrajectoryWindow& window, FunctionValue& value) {
    const Eigen::Index n = window.X.rows();
    for (int i = 0; i < samples_; ++i) {
      const double share = (i + 1.) / samples_;
      map_(posture_.moveTo(window.X.col(0), window.X.col(1), share), at_);
      const Eigen::Index d = at_.y.size();
      value.y.resize(samples_ * d);
      value.J.resize(samples_ * d, 2 * n);
      value.y.segment(i * d, d) = weight_ * at_.y;
      value.J.block(i * d, 0, d, n) = (1 - share) * weight_ * at_.J;
      value.J.block(i * d, n, d, n) = share * weight_ * at_.J;
    }
  }

 private:
  internal::WindowPosture posture_;
  TaskMap map_;
  int samples_;
  double weight_;
  TaskValue at_{};
};

Eigen::Vector3d inBody(const Pose& X_WB, const Eigen::Vector3d& p_W) {
  return X_WB.R.transpose() * (p_W - X_WB.p);
}

// 1 - d / margin of each pair. A single row for the nearest pair would jump where two are equally near.
TaskMap clearanceMap(const ContactModel& contacts, double margin) {
  return [contacts, margin, storage = ProxyStorage(), J = Eigen::Matrix3Xd()](const Posture& at,
                                                                              TaskValue& value) mutable {
    const auto pairs = contacts.pairs();
    value.y.setConstant(static_cast<Eigen::Index>(pairs.size()), -1);
    value.J.setZero(value.y.size(), at.model.nv());
    J.resize(3, at.model.nv());
    proxies(contacts, at.poses, 2 * margin, storage);
    for (Eigen::Index row = 0; row < value.y.size(); ++row) {
      const Proximity& proximity = storage.pairs[static_cast<std::size_t>(row)];
      if (proximity.distance >= 2 * margin) continue;
      value.y[row] = 1 - proximity.distance / margin;
      const ShapePair& pair = pairs[static_cast<std::size_t>(row)];
      const Eigen::RowVector3d direction = -proximity.normal_W.transpose() / margin;
      const BodyId a = contacts.body(pair.a), b = contacts.body(pair.b);
      positionJacobian(at.model, at.poses, a, inBody(at.poses[a], proximity.p_WA), J);
      value.J.row(row).noalias() += direction.lazyProduct(J);
      positionJacobian(at.model, at.poses, b, inBody(at.poses[b], proximity.p_WB), J);
      value.J.row(row).noalias() -= direction.lazyProduct(J);
    }
  };
}

}  // namespace

TrajectoryTerm contactCostTerm(const Model& model, const ContactModel& contacts,
                               const ContactSampling& sampling, double precision) {
  requireSound(model, sampling);
  requirePositive("precision of a contact term", precision);
  const double weight = std::sqrt(precision / sampling.samples);
  return {.name = "contact cost",
          .order = 1,
          .function = SampledMap(model, contactTask(contacts, sampling.margin), sampling.samples, weight)};
}

TrajectoryTerm clearanceTerm(const Model& model, const ContactModel& contacts,
                             const ContactSampling& sampling) {
  requireSound(model, sampling);
  return {.name = "clearance",
          .kind = TermKind::kInequality,
          .order = 1,
          .function = SampledMap(model, clearanceMap(contacts, sampling.margin), sampling.samples, 1)};
}

TrajectoryClearance trajectoryClearance(const Model& model, const ContactModel& contacts,
                                        const MatrixArg& path, double tolerance) {
  requireCount("configurations of a path", path.cols(), 2);
  TrajectoryClearance clearance{.distance = std::numeric_limits<double>::infinity()};
  for (int t = 0; t + 1 < path.cols(); ++t) {
    const double distance = motionClearance(model, contacts, path.col(t), path.col(t + 1), tolerance);
    if (distance < clearance.distance) clearance = {distance, t};
  }
  return clearance;
}

}  // namespace rex

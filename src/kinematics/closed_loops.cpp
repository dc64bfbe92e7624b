#include "kinematics/closed_loops.h"

#include <Eigen/SVD>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "kinematics/jacobians.h"
#include "scene/state.h"

namespace rex {
namespace {

constexpr double kRankTolerance = 1e-9;

// p_WP - p_WQ and its Jacobian.
struct LoopGap {
  Eigen::Vector3d y;
  Eigen::Matrix3Xd J;

  LoopGap(const Posture& at, BodyId a, const Eigen::Vector3d& p_AP, BodyId b, const Eigen::Vector3d& p_BQ)
      : y(position(at.poses, a, p_AP) - position(at.poses, b, p_BQ)),
        J(positionJacobian(at.model, at.poses, a, p_AP)) {
    J -= positionJacobian(at.model, at.poses, b, p_BQ);
  }
};

Eigen::VectorXd leastStep(const Eigen::MatrixXd& J, const Eigen::VectorXd& gap) {
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(kRankTolerance);
  return svd.solve(gap);
}

double largest(const Eigen::VectorXd& y) { return y.size() == 0 ? 0 : y.cwiseAbs().maxCoeff(); }

}  // namespace

TaskMap pinTask(BodyId a, const Eigen::Vector3d& p_AP, BodyId b, const Eigen::Vector3d& p_BQ) {
  return [=](const Posture& at, TaskValue& out) {
    const LoopGap gap(at, a, p_AP, b, p_BQ);
    out.y = gap.y;
    out.J = gap.J;
  };
}

TaskMap rodTask(BodyId a, const Eigen::Vector3d& p_AP, BodyId b, const Eigen::Vector3d& p_BQ, double length) {
  requirePositive("rod: length", length, kMetres);
  return [=](const Posture& at, TaskValue& out) {
    const LoopGap gap(at, a, p_AP, b, p_BQ);
    out.y = Eigen::VectorXd::Constant(1, (gap.y.squaredNorm() - length * length) / (2 * length));
    out.J = gap.y.transpose() * gap.J / length;
  };
}

std::vector<TaskMap> pinTasks(const Model& model) {
  std::vector<TaskMap> maps;
  for (const Pin& pin : model.pins()) maps.push_back(pinTask(pin.a, pin.p_AP, pin.b, pin.p_BQ));
  return maps;
}

TaskValue stackLoops(const Model& model, std::span<const TaskMap> loops, const VectorArg& q) {
  const Eigen::VectorXd posture = q;
  const BodyPoses poses = forwardKinematics(model, posture);
  TaskValue all{Eigen::VectorXd(0), Eigen::MatrixXd(0, model.nv())}, one;
  for (const TaskMap& map : loops) {
    map({model, posture, poses}, one);
    all.y.conservativeResize(all.y.size() + one.y.size());
    all.y.tail(one.y.size()) = one.y;
    all.J.conservativeResize(all.J.rows() + one.J.rows(), Eigen::NoChange);
    all.J.bottomRows(one.J.rows()) = one.J;
  }
  return all;
}

ClosedPosture assemble(const Model& model, std::span<const TaskMap> loops, const VectorArg& q,
                       std::span<const int> driven) {
  constexpr int kMostIterations = 100;
  constexpr double kClosed = 1e-12;
  for (const int index : driven)
    if (index < 0 || index >= model.nv())
      throw Error({.what = "driven joints",
                   .found = fmt::format("entry {} of v", index),
                   .wanted = fmt::format("entries from 0 to {}", model.nv() - 1)});
  ClosedPosture posture{.q = q};
  TaskValue at = stackLoops(model, loops, posture.q);
  for (posture.error = largest(at.y); posture.iterations < kMostIterations; ++posture.iterations) {
    if (posture.error <= kClosed) break;
    for (const int index : driven) at.J.col(index).setZero();
    Eigen::VectorXd step = leastStep(at.J, at.y);
    for (const int index : driven) step[index] = 0;  // to the last bit
    double share = 1;
    for (; share > 1e-6; share /= 2) {
      const Eigen::VectorXd next = integrate(model, posture.q, -share * step);
      const TaskValue there = stackLoops(model, loops, next);
      if (!(there.y.norm() < at.y.norm())) continue;
      posture.q = next;
      at = there;
      break;
    }
    posture.error = largest(at.y);
    if (share <= 1e-6) break;
  }
  if (posture.error <= kClosed) {
    posture.status = ClosedPosture::Status::kClosed;
    posture.message = fmt::format("closed in {} steps", posture.iterations);
  } else if (posture.iterations < kMostIterations) {
    posture.status = ClosedPosture::Status::kStuck;
    posture.message = fmt::format("no step closes the loops: {:.3g} are left", posture.error);
  } else {
    posture.message = fmt::format("not closed in {} steps: {:.3g} are left", kMostIterations, posture.error);
  }
  return posture;
}

Eigen::MatrixXd loopMotions(const Model& model, std::span<const TaskMap> loops, const VectorArg& q) {
  const TaskValue at = stackLoops(model, loops, q);
  if (at.J.rows() == 0) return Eigen::MatrixXd::Identity(model.nv(), model.nv());
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(at.J, Eigen::ComputeFullV);
  svd.setThreshold(kRankTolerance);
  return svd.matrixV().rightCols(model.nv() - svd.rank());
}

}  // namespace rex

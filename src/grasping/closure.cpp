#include "grasping/closure.h"

#include <Eigen/SVD>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require_finite.h"
#include "grasping/cone_checks_internal.h"
#include "optim/linear_program.h"

namespace rex {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kProof = 1e-9;  // of unit wrenches
constexpr int kMostRounds = 100;

struct Span {
  int rank = 0;
  VectorXd normal;  // a unit vector to which the wrenches are closest to orthogonal
};

Span spanOf(const MatrixXd& unit) {
  const Eigen::JacobiSVD<MatrixXd> svd(unit.transpose(), Eigen::ComputeFullV);
  Span span;
  span.rank = static_cast<int>((svd.singularValues().array() > kProof).count());
  span.normal = svd.matrixV().col(unit.rows() - 1);
  return span;
}

// The direction from which all wrenches keep most distance, measured by its largest number: the prices of the
// point of their hull that is nearest to zero by the sum of its numbers. Zero if the hull holds the origin.
VectorXd deepestDirection(const MatrixXd& unit) {
  const Index d = unit.rows(), n = unit.cols();
  MatrixXd A = MatrixXd::Zero(d + 1, n + 2 * d);
  A.topRows(d) << unit, MatrixXd::Identity(d, d), -MatrixXd::Identity(d, d);
  A.bottomLeftCorner(1, n).setOnes();
  VectorXd cost = VectorXd::Ones(n + 2 * d);
  cost.head(n).setZero();
  const LinearSolution nearest = minimizeLinear(A, VectorXd::Unit(d + 1, d), cost);
  const bool isApart = nearest.status == LinearStatus::kOptimal && nearest.value > kProof;
  return isApart ? VectorXd(-nearest.y.head(d)) : VectorXd::Zero(d);
}

Closure openAlong(const MatrixXd& unit, const VectorXd& direction, int rank) {
  Closure closure;
  closure.rank = rank;
  closure.direction = direction.normalized();
  closure.residual = std::max(0.0, -(unit.transpose() * closure.direction).minCoeff());
  const bool isProven = closure.direction.allFinite() && closure.residual < kProof;
  closure.status = isProven ? ClosureStatus::kOpen : ClosureStatus::kUndecided;
  if (!isProven) closure.direction.resize(0);
  closure.message = !isProven ? "rounding decides whether the wrenches counteract all others"
                    : rank < unit.rows()
                        ? fmt::format("the wrenches span {} of {} dimensions", rank, unit.rows())
                        : "all wrenches lie on one side of a plane";
  return closure;
}

Closure closedBy(const MatrixXd& unit, const VectorXd& weights, const VectorXd& size, int rank) {
  Closure closure;
  closure.rank = rank;
  closure.residual = (unit * weights).cwiseAbs().maxCoeff();
  if (!(closure.residual < kProof)) {
    closure.message = "rounding decides whether the wrenches counteract all others";
    return closure;
  }
  closure.status = ClosureStatus::kClosed;
  closure.weights = weights.cwiseQuotient(size);
  closure.weights /= closure.weights.sum();
  closure.message = "the wrenches counteract all others";
  return closure;
}

Closure withoutContacts() { return {.status = ClosureStatus::kOpen, .message = "there are no contacts"}; }

void append(WrenchSet& set, const VectorXd& wrench, int contact) {
  set.wrenches.conservativeResize(Eigen::NoChange, set.wrenches.cols() + 1);
  set.wrenches.rightCols(1) = wrench;
  set.contact.push_back(contact);
}

}  // namespace

Closure forceClosure(const MatrixArg& wrenches) {
  if (wrenches.rows() == 0)
    throw Error({.what = "force closure", .found = "wrenches without numbers", .wanted = "one or more rows"});
  for (Index k = 0; k < wrenches.cols(); ++k)
    requireFinite(fmt::format("force closure: wrench {}", k), VectorXd(wrenches.col(k)));
  if (wrenches.cols() == 0) return withoutContacts();
  VectorXd size = wrenches.colwise().norm().transpose();
  size = (size.array() > 0).select(size, 1);
  const MatrixXd unit = wrenches * size.cwiseInverse().asDiagonal();
  const Span span = spanOf(unit);
  if (span.rank < unit.rows()) return openAlong(unit, span.normal, span.rank);
  const LinearSolution rest = minimizeLinear(unit, -unit.rowwise().sum(), VectorXd::Zero(unit.cols()));
  if (rest.status == LinearStatus::kInfeasible) {
    const VectorXd deepest = deepestDirection(unit);
    return openAlong(unit, deepest.isZero() ? VectorXd(-rest.y) : deepest, span.rank);
  }
  if (rest.status == LinearStatus::kOptimal) return closedBy(unit, rest.x.array() + 1, size, span.rank);
  Closure closure;
  closure.rank = span.rank;
  closure.message = "the linear program stalled";
  return closure;
}

ConeClosure forceClosure(std::span<const WrenchCone> cones) {
  if (cones.empty()) return {.closure = withoutContacts(), .set = {}};
  ConeClosure result{.closure = {}, .set = primitiveWrenches(cones)};
  for (int round = 0; round < kMostRounds; ++round) {
    result.closure = forceClosure(result.set.wrenches);
    if (result.closure.status != ClosureStatus::kOpen) return result;
    bool isSeparating = true;
    for (std::size_t i = 0; i < cones.size(); ++i) {
      const VectorXd lowest = cones[i].lowest(result.closure.direction);
      if (result.closure.direction.dot(lowest) >= -kProof * lowest.norm()) continue;
      append(result.set, lowest, static_cast<int>(i));
      isSeparating = false;
    }
    if (isSeparating) return result;
  }
  result.closure = {.rank = result.closure.rank, .message = "the cones touch the border of closure"};
  return result;
}

Closure formClosure(std::span<const WrenchCone> cones) {
  if (cones.empty()) return withoutContacts();
  internal::requireCones(cones);
  MatrixXd normals(cones[0].normal.size(), static_cast<Index>(cones.size()));
  for (std::size_t i = 0; i < cones.size(); ++i) normals.col(static_cast<Index>(i)) = cones[i].normal;
  return forceClosure(normals);
}

}  // namespace rex

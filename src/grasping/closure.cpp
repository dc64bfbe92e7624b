#include "grasping/closure.h"

#include <Eigen/SVD>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "grasping/centred_view_internal.h"
#include "grasping/cone_checks_internal.h"
#include "optim/linear_program.h"

namespace rex {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kProof = 1e-9;      // of unit wrenches
constexpr double kRounding = 1e-12;  // of unit wrenches, at best
constexpr int kMostRounds = 100;

struct Span {
  int rank = 0;
  VectorXd normal;   // a unit vector to which the wrenches are closest to orthogonal
  double least = 0;  // singular value, of that vector
};

Span spanOf(const MatrixXd& unit) {
  const Eigen::JacobiSVD<MatrixXd> svd(unit.transpose(), Eigen::ComputeFullV);
  Span span;
  span.rank = static_cast<int>((svd.singularValues().array() > kProof).count());
  span.normal = svd.matrixV().col(unit.rows() - 1);
  if (unit.cols() >= unit.rows()) span.least = svd.singularValues()[unit.rows() - 1];
  return span;
}

// The direction, with entries of at most 1, along which all wrenches lie farthest from zero, by the prices of
// the linear program that finds the point of their hull with the least 1-norm. Zero if the hull holds the
// origin.
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

Closure undecided(int rank) {
  return {.rank = rank, .message = "rounding decides whether the wrenches counteract all others"};
}

Closure openAlong(const MatrixXd& unit, const VectorXd& direction, int rank) {
  Closure closure{.status = ClosureStatus::kOpen, .rank = rank, .direction = direction.normalized()};
  closure.residual = std::max(0.0, -(unit.transpose() * closure.direction).minCoeff());
  if (!closure.direction.allFinite() || !(closure.residual < kProof)) return undecided(rank);
  closure.message = rank < unit.rows()
                        ? fmt::format("the wrenches span {} of {} dimensions", rank, unit.rows())
                        : "all wrenches lie on one side of a plane";
  return closure;
}

Closure closedBy(const MatrixXd& unit, const VectorXd& weights, const VectorXd& size, int rank) {
  Closure closure{.status = ClosureStatus::kClosed, .rank = rank};
  closure.residual = (unit * weights).cwiseAbs().maxCoeff();
  if (!(closure.residual < kProof)) return undecided(rank);
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

// `rounding` is the accuracy of the wrenches, as unit vectors.
Closure closureOf(const MatrixXd& wrenches, double rounding) {
  if (wrenches.rows() == 0)
    throw Error({.what = "force closure", .found = "wrenches without numbers", .wanted = "one or more rows"});
  for (Index k = 0; k < wrenches.cols(); ++k)
    requireFinite(fmt::format("force closure: wrench {}", k), VectorXd(wrenches.col(k)));
  if (wrenches.cols() == 0) return withoutContacts();
  VectorXd size = wrenches.colwise().norm().transpose();
  size = (size.array() > 0).select(size, 1);
  const MatrixXd unit = wrenches * size.cwiseInverse().asDiagonal();
  const Span span = spanOf(unit);
  if (rounding > kProof || (span.rank < unit.rows() && span.least > rounding)) return undecided(span.rank);
  if (span.rank < unit.rows()) return openAlong(unit, span.normal, span.rank);
  const LinearSolution rest = minimizeLinear(unit, -unit.rowwise().sum(), VectorXd::Zero(unit.cols()));
  if (rest.status == LinearStatus::kInfeasible) {
    const VectorXd deepest = deepestDirection(unit);
    return openAlong(unit, deepest.isZero() ? VectorXd(-rest.y) : deepest, span.rank);
  }
  if (rest.status == LinearStatus::kOptimal) return closedBy(unit, rest.x.array() + 1, size, span.rank);
  return {.rank = span.rank, .message = "the linear program stalled"};
}

void bringBack(const MatrixXd& map, Closure& closure) {
  if (closure.direction.size() > 0) closure.direction = (map.transpose() * closure.direction).normalized();
}

}  // namespace

Closure forceClosure(const MatrixArg& wrenches) { return closureOf(wrenches, kRounding); }

ConeClosure forceClosure(std::span<const WrenchCone> cones) {
  if (cones.empty()) return {.closure = withoutContacts(), .set = {}};
  ConeClosure result{.closure = {}, .set = primitiveWrenches(cones)};
  const internal::CentredView view = internal::centredView(cones);
  for (int round = 0; round < kMostRounds; ++round) {
    result.closure = closureOf(view.map * result.set.wrenches, view.rounding);
    if (result.closure.status != ClosureStatus::kOpen) return result;
    bool isSeparating = true;
    for (std::size_t i = 0; i < cones.size(); ++i) {
      const VectorXd lowest = cones[i].lowest(view.map.transpose() * result.closure.direction);
      const VectorXd seen = view.map * lowest;
      if (result.closure.direction.dot(seen) >= -kProof * seen.norm()) continue;
      append(result.set, lowest, static_cast<int>(i));
      isSeparating = false;
    }
    if (!isSeparating) continue;
    bringBack(view.map, result.closure);
    return result;
  }
  result.closure = {.rank = result.closure.rank, .message = "the cones touch the border of closure"};
  return result;
}

Closure formClosure(std::span<const WrenchCone> cones) {
  if (cones.empty()) return withoutContacts();
  internal::requireCones(cones);
  MatrixXd normals(cones[0].normal.size(), static_cast<Index>(cones.size()));
  for (std::size_t i = 0; i < cones.size(); ++i) normals.col(static_cast<Index>(i)) = cones[i].normal;
  return internal::forceClosure(normals, internal::centredView(cones));
}

namespace internal {

Closure forceClosure(const MatrixXd& wrenches, const CentredView& view) {
  Closure closure = closureOf(view.map * wrenches, view.rounding);
  bringBack(view.map, closure);
  return closure;
}

}  // namespace internal

}  // namespace rex

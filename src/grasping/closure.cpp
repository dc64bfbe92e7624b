#include "grasping/closure.h"

#include <algorithm>
#include <numeric>
#include <span>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "geometry/rotation.h"
#include "grasping/wrench_cone_internal.h"
#include "optim/linear_program.h"

namespace rex::internal {

/// Wrenches as seen from the middle of their contacts, with torques divided by the contacts' spread: an
/// invertible map, on which closure does not depend but rounding does.
struct CentredView {
  Eigen::MatrixXd map{};  ///< d x d, times a wrench
  double rounding = 0;    ///< of unit wrenches seen so: it grows with the distance of the reference point
};

/// The view of cones that have passed requireCones(). Where they are not those of contacts in space or in the
/// plane, wrenches stay as they are.
[[nodiscard]] CentredView centredView(std::span<const WrenchCone> cones);

/// forceClosure() of the wrenches (d x N) in this view, but for the direction, which is for the wrenches
/// themselves.
[[nodiscard]] Closure forceClosure(const Eigen::MatrixXd& wrenches, const CentredView& view);

namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRounding = 4e-15;       // of the point of a contact, if torques are taken far from it
constexpr double kLeastRounding = 1e-12;  // contacts are known no better than this

// The point p of a contact, from the reference point and in its units of length: the torques p x f of all
// axes f of the contact give it.
Vector3d pointOf(const WrenchCone& cone) {
  MatrixXd axes(cone.normal.size(), 1 + cone.tangents.cols());
  axes << cone.normal, cone.tangents;
  Vector3d p = Vector3d::Zero();
  for (const auto& w : axes.colwise())
    if (w.size() == 6)
      p += Vector3d(w.head<3>()).cross(Vector3d(w.tail<3>())) / 2;
    else
      p.head<2>() += w[2] * Vector2d(w[1], -w[0]);
  return p;
}

// The map that moves the reference point to c and divides torques by the length.
MatrixXd movedTo(const Vector3d& c, double length, Index size) {
  MatrixXd map = MatrixXd::Identity(size, size);
  if (size == 6) {
    map.bottomLeftCorner<3, 3>() = -skew(c) / length;
    map.bottomRightCorner<3, 3>() /= length;
  } else {
    map.row(2) << c.y() / length, -c.x() / length, 1 / length;
  }
  return map;
}

}  // namespace

CentredView centredView(std::span<const WrenchCone> cones) {
  const Index size = cones[0].normal.size(), tangents = cones[0].tangents.cols();
  if (!(size == 6 && tangents == 2) && !(size == 3 && tangents == 1))
    return {.map = MatrixXd::Identity(size, size), .rounding = kLeastRounding};
  Matrix3Xd points(3, static_cast<Index>(cones.size()));
  for (std::size_t i = 0; i < cones.size(); ++i) points.col(static_cast<Index>(i)) = pointOf(cones[i]);
  const Vector3d middle = points.rowwise().mean();
  const double far = middle.norm();
  double spread = (points.colwise() - middle).colwise().norm().maxCoeff();
  if (!(spread > kRounding * far)) spread = far > 0 ? far : 1;  // all at one point, up to rounding
  return {.map = movedTo(middle, spread, size),
          .rounding = std::max(kLeastRounding, kRounding * far / spread)};
}

}  // namespace rex::internal

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

namespace {

using Eigen::Index;

void requireOrder(std::span<const int> order, std::size_t contacts) {
  std::vector<int> sorted(order.begin(), order.end()), all(contacts);
  std::sort(sorted.begin(), sorted.end());
  std::iota(all.begin(), all.end(), 0);
  if (sorted != all)
    throw Error({.what = "deletion synthesis: order",
                 .found = fmt::format("{}", fmt::join(order, " ")),
                 .wanted = fmt::format("each contact from 0 to {} once", static_cast<long>(contacts) - 1)});
}

// The edges of the contacts that are kept.
Eigen::MatrixXd wrenchesOf(const WrenchSet& set, const std::vector<bool>& isKept) {
  std::vector<Index> columns;
  for (std::size_t j = 0; j < set.contact.size(); ++j)
    if (isKept[static_cast<std::size_t>(set.contact[j])]) columns.push_back(static_cast<Index>(j));
  return set.wrenches(Eigen::all, columns);
}

}  // namespace

DeletionSynthesis deleteRedundant(std::span<const WrenchCone> cones, std::span<const int> order, int edges) {
  requireOrder(order, cones.size());
  DeletionSynthesis result;
  const WrenchSet set = primitiveWrenches(cones, edges);
  if (cones.empty()) {
    result.status = ClosureStatus::kOpen;
    result.message = "there are no contacts";
    return result;
  }
  const internal::CentredView view = internal::centredView(cones);
  result.closure = internal::forceClosure(set.wrenches, view);
  result.status = result.closure.status;
  result.message = result.closure.message;
  if (result.status != ClosureStatus::kClosed) return result;
  std::vector<bool> isKept(cones.size(), true);
  for (const int contact : order) {
    isKept[static_cast<std::size_t>(contact)] = false;
    Closure rest = internal::forceClosure(wrenchesOf(set, isKept), view);
    if (rest.status == ClosureStatus::kClosed)
      result.closure = std::move(rest);
    else
      isKept[static_cast<std::size_t>(contact)] = true;
  }
  for (std::size_t i = 0; i < cones.size(); ++i)
    if (isKept[i]) result.kept.push_back(static_cast<int>(i));
  result.message = fmt::format("{} of {} contacts hold", result.kept.size(), cones.size());
  return result;
}

DeletionSynthesis deleteRedundant(std::span<const WrenchCone> cones, int edges) {
  std::vector<int> order(cones.size());
  std::iota(order.begin(), order.end(), 0);
  return deleteRedundant(cones, order, edges);
}

}  // namespace rex

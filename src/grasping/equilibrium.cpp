#include "grasping/equilibrium.h"

#include <limits>

#include <Eigen/QR>

#include "base/error.h"
#include "base/require.h"
#include "grasping/wrench_cone_internal.h"
#include "optim/linear_program.h"

namespace rex {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kEquilibriumProof = 1e-9;
constexpr int kMostForceRounds = 100;

// A linear program over forces on edges of cones, which get further edges as long as those lower its cost.
// Its rows are the d numbers of wrenches and, with a limit, one row per contact: sum / limit + slack = 1.
class EdgeProgram {
 public:
  EdgeProgram(std::span<const WrenchCone> cones, std::optional<double> limit)
      : cones_(cones), limit_(limit), set_(primitiveWrenches(cones)) {}

  // Minimises edgeCost * (sum of all forces) - multiple subject to wrenches + multiple * load = -constant,
  // with multiple = 0 if `load` is zero.
  LinearSolution solve(double edgeCost, const VectorXd& load, const VectorXd& constant) {
    LinearSolution solution;
    for (int round = 0; round < kMostForceRounds; ++round) {
      solution = solveOnce(edgeCost, load, constant);
      const bool isOver =
          solution.status == LinearStatus::kUnbounded || solution.status == LinearStatus::kStalled;
      const double cost = solution.status == LinearStatus::kOptimal ? edgeCost : 0;
      if (isOver || !addEdges(cost, solution.y)) break;
    }
    return solution;
  }

  // In the frames of the contacts: normal forces, and below them those along the tangents.
  MatrixXd forces(const VectorXd& x) const {
    const Index rows = 1 + cones_[0].tangents.cols();
    MatrixXd forces = MatrixXd::Zero(rows, size());
    MatrixXd wrenches = MatrixXd::Zero(set_.wrenches.rows(), size());
    for (Index j = 0; j < set_.wrenches.cols(); ++j) {
      const int contact = set_.contact[static_cast<std::size_t>(j)];
      forces(0, contact) += x[j];
      wrenches.col(contact) += x[j] * set_.wrenches.col(j);
    }
    for (Index i = 0; i < size(); ++i) {
      const WrenchCone& cone = cones_[static_cast<std::size_t>(i)];
      if (cone.friction == 0) continue;
      const VectorXd tangential = wrenches.col(i) - forces(0, i) * cone.normal,
                     shares = cone.tangents.colPivHouseholderQr().solve(tangential);
      forces.col(i).tail(rows - 1) = shares;
    }
    return forces;
  }

  // The most that all contacts together push against a unit wrench; without a limit infinite if they can.
  double most(const VectorXd& direction) const {
    double sum = 0;
    for (const WrenchCone& cone : cones_) {
      const VectorXd lowest = cone.lowest(direction);
      const double against = -direction.dot(lowest);
      if (limit_)
        sum += *limit_ * std::max(0.0, against);
      else if (against > kEquilibriumProof * lowest.norm())
        return std::numeric_limits<double>::infinity();
    }
    return sum;
  }

 private:
  Index size() const { return static_cast<Index>(cones_.size()); }

  LinearSolution solveOnce(double edgeCost, const VectorXd& load, const VectorXd& constant) const {
    const Index d = set_.wrenches.rows(), edges = set_.wrenches.cols(), limits = limit_ ? size() : 0;
    MatrixXd A = MatrixXd::Zero(d + limits, edges + limits + 1);
    A.topLeftCorner(d, edges) = set_.wrenches;
    A.topRightCorner(d, 1) = load;
    A.block(d, edges, limits, limits).setIdentity();
    for (Index j = 0; j < edges && limit_; ++j)
      A(d + set_.contact[static_cast<std::size_t>(j)], j) = 1 / *limit_;
    VectorXd b(d + limits), cost = VectorXd::Zero(edges + limits + 1);
    b << -constant, VectorXd::Ones(limits);
    cost.head(edges).setConstant(edgeCost);
    cost[edges + limits] = load.isZero() ? 0 : -1;
    return minimizeLinear(A, b, cost);
  }

  bool addEdges(double edgeCost, const VectorXd& y) {
    const Index d = set_.wrenches.rows(), before = set_.wrenches.cols();
    const double smallest = kEquilibriumProof * (edgeCost + y.norm());
    for (Index i = 0; i < size(); ++i) {
      const VectorXd edge = cones_[static_cast<std::size_t>(i)].lowest(-y.head(d));
      const double gain = y.head(d).dot(edge) + (limit_ ? y[d + i] / *limit_ : 0) - edgeCost;
      if (gain <= smallest * edge.norm()) continue;
      set_.wrenches.conservativeResize(Eigen::NoChange, set_.wrenches.cols() + 1);
      set_.wrenches.rightCols(1) = edge;
      set_.contact.push_back(static_cast<int>(i));
    }
    return set_.wrenches.cols() > before;
  }

  std::span<const WrenchCone> cones_;
  std::optional<double> limit_;
  WrenchSet set_;
};

void requireLoad(std::span<const WrenchCone> cones, const VectorXd& load, std::optional<double> limit) {
  internal::requireCones(cones);
  if (!cones.empty()) requireSize("equilibrium: load", load.size(), cones[0].normal.size());
  requireFinite("equilibrium: load", load);
  if (limit) requirePositive("equilibrium: largest normal force", *limit);
}

// The wrench of all forces in the frames of their contacts.
VectorXd totalOf(std::span<const WrenchCone> cones, const MatrixXd& forces_C) {
  VectorXd total = VectorXd::Zero(cones[0].normal.size());
  for (std::size_t i = 0; i < cones.size(); ++i) {
    const VectorXd f = forces_C.col(static_cast<Index>(i)), tangential = f.tail(f.size() - 1);
    total += cones[i].normal * f[0] + cones[i].tangents * tangential;
  }
  return total;
}

Equilibrium undecided(std::string message) { return {.message = std::move(message)}; }

Equilibrium notHeld(const EdgeProgram& program, const VectorXd& direction, const VectorXd& load) {
  const double margin = direction.dot(load) - program.most(direction);
  if (!(margin > kEquilibriumProof)) return undecided("rounding decides whether the load is held");
  return {.status = EquilibriumStatus::kNotHeld,
          .direction = direction,
          .residual = margin,
          .message = "the load overcomes the contacts in one direction"};
}

Equilibrium withoutContacts(const VectorXd& load) {
  if (load.isZero(0))
    return {.status = EquilibriumStatus::kHeld, .message = "there is no load, and no contact"};
  return {.status = EquilibriumStatus::kNotHeld,
          .direction = load.normalized(),
          .residual = load.norm(),
          .message = "there are no contacts"};
}

}  // namespace

Equilibrium equilibrium(std::span<const WrenchCone> cones, const VectorArg& load,
                        std::optional<double> maxNormalForce) {
  requireLoad(cones, load, maxNormalForce);
  if (cones.empty()) return withoutContacts(load);
  // All forces in units of the load.
  const double unit = load.isZero(0) ? 1 : load.norm();
  const VectorXd scaled = load / unit;
  if (maxNormalForce) *maxNormalForce /= unit;
  EdgeProgram program(cones, maxNormalForce);
  const LinearSolution solution = program.solve(1, VectorXd::Zero(load.size()), scaled);
  Equilibrium result;
  if (solution.status == LinearStatus::kInfeasible) {
    result = notHeld(program, -solution.y.head(load.size()).normalized(), scaled);
  } else if (solution.status == LinearStatus::kOptimal) {
    result = {.status = EquilibriumStatus::kHeld, .message = "the contacts hold the load"};
    result.forces_C = program.forces(solution.x);
    result.residual = (totalOf(cones, result.forces_C) + scaled).norm();
    if (!(result.residual < 1e-8)) return undecided("rounding decides whether the load is held");
    result.forces_C *= unit;
  } else {
    return undecided("the linear program stalled");
  }
  result.residual *= unit;
  return result;
}

LargestLoad largestLoad(std::span<const WrenchCone> cones, const VectorArg& load,
                        std::optional<double> maxNormalForce) {
  requireLoad(cones, load, maxNormalForce);
  if (load.isZero(0))
    throw Error({.what = "largest load", .found = "a load of zero", .wanted = "a direction"});
  if (cones.empty())
    return {
        .status = LoadStatus::kBounded, .direction = load.normalized(), .message = "there are no contacts"};
  // All forces in units of the limit.
  const double unit = maxNormalForce.value_or(1);
  EdgeProgram program(cones, maxNormalForce ? std::optional<double>(1) : std::nullopt);
  const LinearSolution solution = program.solve(0, load.normalized(), VectorXd::Zero(load.size()));
  if (solution.status == LinearStatus::kUnbounded)
    return {.status = LoadStatus::kUnbounded, .message = "the contacts hold any multiple of the load"};
  if (solution.status != LinearStatus::kOptimal) return {.message = "the linear program stalled"};
  const double most = solution.x[solution.x.size() - 1] * unit / load.norm();
  return {
      .status = LoadStatus::kBounded,
      .factor = most,
      .forces_C = program.forces(solution.x) * unit,
      .direction = -solution.y.head(load.size()).normalized(),
      .message = most > 0 ? "the contacts hold the load up to a limit" : "the contacts cannot hold the load"};
}

}  // namespace rex

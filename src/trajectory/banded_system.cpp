#include <fmt/format.h>

#include "base/error.h"
#include "trajectory/banded_system_internal.h"

namespace rex::internal {
namespace {

std::string placeOf(const TrajectoryTerm& term, int t) {
  return fmt::format("'{}' at step {}", term.name, t);
}

}  // namespace

BandedSystem::BandedSystem(const TrajectoryProblem& problem)
    : problem_(problem),
      path_(problem.n(), problem.prefix().cols() + problem.steps()),
      A_(emptyBand<double>()),
      factor_(A_) {
  path_.leftCols(problem.prefix().cols()) = problem.prefix();
  for (const TrajectoryTerm& term : problem.terms())
    for (int t = term.first; t <= term.last.value_or(problem.steps() - 1); ++t)
      parts_.push_back({.term = &term, .t = t});
}

void BandedSystem::evaluate(const Eigen::VectorXd& x, ConstrainedValues& values) {
  path_.rightCols(problem_.steps()).reshaped() = x;
  for (Part& part : parts_) evaluate(part);
  countRows();
  values.cost = 0;
  values.g.resize(rows_[static_cast<int>(TermKind::kInequality)]);
  values.h.resize(rows_[static_cast<int>(TermKind::kEquality)]);
  for (const Part& part : parts_) {
    const Eigen::VectorXd& y = part.value.y;
    switch (part.term->kind) {
      case TermKind::kCost:
        values.cost += y.squaredNorm();
        break;
      case TermKind::kInequality:
        values.g.segment(part.row, y.size()) = y;
        break;
      case TermKind::kEquality:
        values.h.segment(part.row, y.size()) = y;
        break;
    }
  }
}

void BandedSystem::evaluate(Part& part) {
  const int order = part.term->order;
  const Eigen::Index d = part.value.y.size();
  const Eigen::Index first = problem_.prefix().cols() + part.t - order;
  part.term->function({.t = part.t, .tau = problem_.tau(), .X = path_.middleCols(first, order + 1)},
                      part.value);
  const FunctionValue& value = part.value;
  if (hasCounted_ && value.y.size() != d)
    requireSize("value of term " + placeOf(*part.term, part.t), value.y.size(), d);
  if (value.J.rows() == value.y.size() && value.J.cols() == (order + 1) * problem_.n()) return;
  throw Error({.what = fmt::format("Jacobian of term {}", placeOf(*part.term, part.t)),
               .found = fmt::format("{} x {}", value.J.rows(), value.J.cols()),
               .wanted = fmt::format("{} x {}", value.y.size(), (order + 1) * problem_.n())});
}

// Sizes are known once all terms were evaluated.
void BandedSystem::countRows() {
  if (hasCounted_) return;
  for (Part& part : parts_) {
    Eigen::Index& rows = rows_[static_cast<int>(part.term->kind)];
    part.row = rows;
    rows += part.value.y.size();
  }
  hasCounted_ = true;
}

double BandedSystem::curvatureOf(const ConstraintWeights& weights, const Part& part, Eigen::Index row) {
  switch (part.term->kind) {
    case TermKind::kInequality:
      return weights.gg[part.row + row];
    case TermKind::kEquality:
      return weights.hh[part.row + row];
    case TermKind::kCost:
      break;
  }
  return 2 * weights.cost;
}

double BandedSystem::slopeOf(const ConstraintWeights& weights, const Part& part, Eigen::Index row) {
  switch (part.term->kind) {
    case TermKind::kInequality:
      return weights.g[part.row + row];
    case TermKind::kEquality:
      return weights.h[part.row + row];
    case TermKind::kCost:
      break;
  }
  return 2 * weights.cost * part.value.y[row];
}

void BandedSystem::gradientOf(const ConstraintWeights& weights, Eigen::VectorXd& gradient) const {
  gradient.setZero(A_.size());
  forEachRow([&](const Part& part, Eigen::Index row) {
    const double slope = slopeOf(weights, part, row);
    if (slope == 0) return;
    const int first = part.firstPlace(problem_);
    for (Eigen::Index c = std::max(0, -first); c < part.value.J.cols(); ++c)
      gradient[first + c] += slope * part.value.J(row, c);
  });
}

void BandedSystem::changeOfG(const Eigen::VectorXd& step, Eigen::VectorXd& change) const {
  change.setZero(rows_[static_cast<int>(TermKind::kInequality)]);
  for (const Part& part : parts_) {
    if (part.term->kind != TermKind::kInequality) continue;
    const int first = part.firstPlace(problem_);
    const Eigen::Index given = std::max(0, -first), moved = part.value.J.cols() - given;  // the prefix stays
    change.segment(part.row, part.value.y.size()).noalias() =
        part.value.J.rightCols(moved) * step.segment(first + given, moved);
  }
}

void BandedSystem::assemble(const ConstraintWeights& weights) {
  A_.setZero();
  addSquares(weights, A_, room_);
}

bool BandedSystem::solve(double damping, const Eigen::VectorXd& gradient, Eigen::VectorXd& step) {
  double largest = 1;
  for (int i = 0; i < A_.size(); ++i) largest = std::max(largest, A_.at(i, i));
  if (!factor_.factor(A_, damping * largest)) return false;
  step = -gradient;
  factor_.solveInPlace({step.data(), static_cast<std::size_t>(step.size())});
  return step.allFinite();
}

std::string BandedSystem::nameOf(TermKind kind, Eigen::Index row) const {
  for (const Part& part : parts_) {
    const Eigen::Index size = part.value.y.size();
    if (part.term->kind == kind && row >= part.row && row < part.row + size)
      return placeOf(*part.term, part.t) + (size > 1 ? fmt::format(", row {}", row - part.row) : "");
  }
  return {};
}

std::string BandedSystem::inequalityName(Eigen::Index row) const {
  return nameOf(TermKind::kInequality, row);
}
std::string BandedSystem::equalityName(Eigen::Index row) const { return nameOf(TermKind::kEquality, row); }

}  // namespace rex::internal

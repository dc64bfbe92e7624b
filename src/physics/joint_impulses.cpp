#include <algorithm>
#include <cmath>

#include "physics/joint_impulses_internal.h"

namespace rex::internal {
namespace {

// So many times all move at once, which nearly always ends it; then one at a time, which cannot cycle.
constexpr int kRoundsTogether = 8, kRounds = 200;
// Impulses and velocities lie outside if they do so by more, relative to their size.
constexpr double kRounding = 1e-12;

bool isBelow(double x, double bound) {
  return std::isinf(bound) ? x < bound : x < bound - kRounding * (1 + std::abs(bound));
}

}  // namespace

JointImpulses::JointImpulses(Eigen::Index count)
    : coordinates_(static_cast<std::size_t>(count)),
      A_(count, count),
      b_(count),
      impulse_(count),
      llt_(count) {}

void JointImpulses::reset() {
  for (Coordinate& one : coordinates_) one.last = -1;
}

void JointImpulses::insert(Coordinate& one, const Edge& edge) {
  Edge* at = one.edges.data();
  Edge* const end = at + one.count;
  while (at != end && at->velocity < edge.velocity) ++at;
  if (at != end && at->velocity == edge.velocity) {
    at->lowest += edge.lowest;
    at->highest += edge.highest;
    return;
  }
  std::move_backward(at, end, end + 1);
  *at = edge;
  ++one.count;
}

void JointImpulses::set(Eigen::Index i, const JointGoals& goals) {
  Coordinate& one = coordinates_[static_cast<std::size_t>(i)];
  one.count = 0;
  one.softening = goals[kDamping] ? 1 / goals[kDamping]->softness : 0;
  for (const int purpose : {kLowerLimit, kUpperLimit, kFriction, kMotor}) {
    if (!goals[purpose]) continue;
    Edge edge{goals[purpose]->velocity, goals[purpose]->lowest, goals[purpose]->highest, purpose};
    // However strong a motor is, limits stop it.
    if (purpose == kMotor && goals[kLowerLimit])
      edge.velocity = std::max(edge.velocity, goals[kLowerLimit]->velocity);
    if (purpose == kMotor && goals[kUpperLimit])
      edge.velocity = std::min(edge.velocity, goals[kUpperLimit]->velocity);
    insert(one, edge);
  }
}

// The impulse above so many edges.
double JointImpulses::impulseAbove(const Coordinate& one, int edges) {
  double sum = 0;
  for (int k = 0; k < one.count; ++k)
    sum += k < edges ? one.edges[static_cast<std::size_t>(k)].lowest
                     : one.edges[static_cast<std::size_t>(k)].highest;
  return sum;
}

// Whether it lies beyond a limit or where a motor of any strength does not let it.
bool JointImpulses::isForbidden(const Coordinate& one) {
  return one.place % 2 == 0 && std::isinf(impulseAbove(one, one.place / 2));
}

// Begins where the last step ended.
void JointImpulses::begin(const Eigen::VectorXd& v) {
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    Coordinate& one = coordinates_[i];
    one.place = 0;
    for (int k = 0; k < one.count; ++k) {
      const Edge& edge = one.edges[static_cast<std::size_t>(k)];
      if (edge.purpose == one.last) {
        one.place = 2 * k + 1;
        break;
      }
      if (edge.velocity < v[static_cast<Eigen::Index>(i)]) one.place = 2 * k + 2;
    }
    if (isForbidden(one)) one.place += impulseAbove(one, one.place / 2) > 0 ? 1 : -1;
  }
}

// Moves coordinate i to the next place if it does not belong where it is.
bool JointImpulses::move(Eigen::Index i, double v, double impulse) {
  Coordinate& one = coordinates_[static_cast<std::size_t>(i)];
  const int k = one.place / 2;
  int way = 0;
  if (one.place % 2 == 1) {
    if (isBelow(impulseAbove(one, k), impulse)) way = -1;
    if (isBelow(impulse, impulseAbove(one, k + 1))) way = 1;
  } else {
    if (k < one.count && isBelow(one.edges[static_cast<std::size_t>(k)].velocity, v)) way = 1;
    if (k > 0 && isBelow(v, one.edges[static_cast<std::size_t>(k) - 1].velocity)) way = -1;
  }
  one.place += way;
  if (isForbidden(one)) one.place += way;
  return way != 0;
}

bool JointImpulses::solve(Eigen::MatrixXd& M, const Eigen::VectorXd& p, Eigen::VectorXd& v) {
  const Eigen::Index count = v.size();
  begin(v);
  for (Eigen::Index i = 0; i < count; ++i) M(i, i) += coordinates_[static_cast<std::size_t>(i)].softening;
  for (int round = 0; round < kRounds; ++round) {
    // Coordinates at an edge have its velocity; the others move as their impulses tell.
    A_ = M;
    b_ = p;
    for (Eigen::Index i = 0; i < count; ++i) {
      const Coordinate& one = coordinates_[static_cast<std::size_t>(i)];
      if (one.place % 2 == 0) {
        b_[i] += impulseAbove(one, one.place / 2);
      } else {
        v[i] = one.edges[static_cast<std::size_t>(one.place / 2)].velocity;
        b_.noalias() -= M.col(i) * v[i];
      }
    }
    for (Eigen::Index i = 0; i < count; ++i) {
      const Coordinate& one = coordinates_[static_cast<std::size_t>(i)];
      if (one.place % 2 == 0) continue;
      A_.row(i).setZero();
      A_.col(i).setZero();
      A_(i, i) = 1;
      b_[i] = v[i];
    }
    llt_.compute(A_);
    if (llt_.info() != Eigen::Success) return false;
    llt_.solveInPlace(b_);
    v = b_;
    impulse_.noalias() = M * v;
    impulse_ -= p;
    bool hasMoved = false;
    for (Eigen::Index i = 0; i < count && (round < kRoundsTogether || !hasMoved); ++i)
      hasMoved = move(i, v[i], impulse_[i]) || hasMoved;
    if (hasMoved) continue;
    for (Coordinate& one : coordinates_)
      one.last = one.place % 2 == 1 ? one.edges[static_cast<std::size_t>(one.place / 2)].purpose : -1;
    return true;
  }
  return false;
}

}  // namespace rex::internal

#include <algorithm>

#include "physics/pin_rows_internal.h"

namespace rex::internal {
namespace {

constexpr int kAxes = 3;
// Gaps, which each step of finite length opens, close at this rate, 1/s: a fifth of them in a millisecond.
// Those at the start are as slow as what parts from an overlap, m/s: what the pin moves keeps its speed
// afterwards.
constexpr double kClosingRate = 200, kClosingSpeed = 1;

}  // namespace

PinRows::PinRows(const PinEnd& A, const PinEnd& B)
    : HeldRows(A.body, B.body ? B.body : A.body, A.link, B.body ? B.link : A.link, kAxes, false,
               MULTIBODY_CONSTRAINT_POINT_TO_POINT),
      A_(A),
      B_(B) {
  PinRows::finalizeMultiDof();
}

double PinRows::wanted(int row) const {
  return -kClosingRate * gap_[row] / std::max(1.0, kClosingRate / kClosingSpeed * gap_.length());
}

void PinRows::measure(const PinEnd& end, const btVector3& axis, double sign, double* coefficients,
                      btMultiBodyJacobianData& data) {
  if (end.body == nullptr) return;
  one_.resize(velocityCount(*end.body));
  end.body->fillConstraintJacobianMultiDof(end.link, end.inWorld(), btVector3(0, 0, 0), axis, &one_[0],
                                           data.scratch_r, data.scratch_v, data.scratch_m);
  for (int i = 0; i < one_.size(); ++i) coefficients[i] += sign * one_[i];
}

void PinRows::createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                                   const btContactSolverInfo& info) {
  gap_ = A_.inWorld() - B_.inWorld();
  for (int i = 0; i < kAxes; ++i) {
    btVector3 axis(0, 0, 0);
    axis[i] = 1;
    std::fill_n(jacobianA(i), velocityCount(*m_bodyA), 0.0);
    if (!isInOneBody()) std::fill_n(jacobianB(i), velocityCount(*m_bodyB), 0.0);
    measure(A_, axis, 1, jacobianA(i), data);
    measure(B_, axis, -1, isInOneBody() ? jacobianA(i) : jacobianB(i), data);
    addRow(i, wanted(i), rows, data, info);
  }
}

}  // namespace rex::internal

#pragma once

#include "physics/held_rows_internal.h"

namespace rex::internal {

/// A point of a pin in Bullet: fixed in a link (-1: the base) of a body, or, without one, in W.
struct PinEnd {
  btMultiBody* body = nullptr;
  int link = -1;
  btVector3 point{0, 0, 0};

  [[nodiscard]] btVector3 inWorld() const { return body ? body->localPosToWorld(link, point) : point; }
};

/// Keeps two points together: a row for each axis of W.
class PinRows : public HeldRows {
 public:
  /// The body of A moves.
  PinRows(const PinEnd& A, const PinEnd& B);

  [[nodiscard]] double wanted(int row) const override;
  void finalizeMultiDof() override { allocateJacobiansMultiDof(); }
  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override;

 private:
  // Adds the velocity of an end along the axis, times `sign`, to the coefficients of its body.
  void measure(const PinEnd& end, const btVector3& axis, double sign, double* coefficients,
               btMultiBodyJacobianData& data);

  PinEnd A_, B_;
  btVector3 gap_{0, 0, 0};
  btAlignedObjectArray<btScalar> one_;
};

}  // namespace rex::internal

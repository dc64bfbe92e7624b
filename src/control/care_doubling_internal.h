#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "control/riccati.h"

namespace rex::internal {

/// A matrix of extended precision (64 bits of mantissa), for residuals: plain loops, for Eigen's templates
/// would be compiled anew for this type. Columns lie one after the other.
class ExtendedMatrix {
 public:
  using Number = long double;

  /// Zeros.
  ExtendedMatrix(Eigen::Index rows, Eigen::Index columns);
  explicit ExtendedMatrix(const Eigen::Ref<const Eigen::MatrixXd>& values);

  [[nodiscard]] Eigen::Index rows() const { return rows_; }
  [[nodiscard]] Eigen::Index columns() const { return columns_; }
  [[nodiscard]] Number* column(Eigen::Index j) { return &values_[static_cast<std::size_t>(j * rows_)]; }
  [[nodiscard]] const Number* column(Eigen::Index j) const {
    return &values_[static_cast<std::size_t>(j * rows_)];
  }
  [[nodiscard]] Eigen::MatrixXd rounded() const;
  /// Frobenius norm.
  [[nodiscard]] Number norm() const;
  [[nodiscard]] ExtendedMatrix transpose() const;

  /// Of the same size.
  ExtendedMatrix& operator+=(const ExtendedMatrix& other);
  ExtendedMatrix& operator-=(const ExtendedMatrix& other);

 private:
  Eigen::Index rows_, columns_;
  std::vector<Number> values_;
};

/// A B, for A with as many columns as B has rows.
[[nodiscard]] ExtendedMatrix product(const ExtendedMatrix& A, const ExtendedMatrix& B);
/// A^T B, for A and B with as many rows.
[[nodiscard]] ExtendedMatrix transposedProduct(const ExtendedMatrix& A, const ExtendedMatrix& B);
/// The X of A X = B for a square A, by elimination with row pivots; not finite where A is singular.
[[nodiscard]] ExtendedMatrix solved(ExtendedMatrix A, ExtendedMatrix B);

/// solveCare() for problems that are easy to solve, many times as fast: structure-preserving doubling (Chu,
/// Fan and Lin 2005), then Newton steps with residuals in extended precision. Sizes and numbers are sound.
/// Empty where it does not converge quickly to an X whose closed loop is safely stable.
[[nodiscard]] std::optional<RiccatiResult> careByDoubling(const MatrixArg& A, const MatrixArg& B,
                                                          const MatrixArg& Q, const MatrixArg& R);

}  // namespace rex::internal

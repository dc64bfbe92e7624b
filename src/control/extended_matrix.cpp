#include <cmath>
#include <utility>

#include "control/extended_matrix_internal.h"

namespace rex::internal {

using Eigen::Index;
using Number = ExtendedMatrix::Number;

ExtendedMatrix::ExtendedMatrix(Index rows, Index columns)
    : rows_(rows), columns_(columns), values_(static_cast<std::size_t>(rows * columns), 0) {}

ExtendedMatrix::ExtendedMatrix(const Eigen::Ref<const Eigen::MatrixXd>& values)
    : ExtendedMatrix(values.rows(), values.cols()) {
  for (Index j = 0; j < columns_; ++j)
    for (Index i = 0; i < rows_; ++i) column(j)[i] = values(i, j);
}

Eigen::MatrixXd ExtendedMatrix::rounded() const {
  Eigen::MatrixXd result(rows_, columns_);
  for (Index j = 0; j < columns_; ++j)
    for (Index i = 0; i < rows_; ++i) result(i, j) = static_cast<double>(column(j)[i]);
  return result;
}

Number ExtendedMatrix::norm() const {
  Number sum = 0;
  for (const Number value : values_) sum += value * value;
  return std::sqrt(sum);
}

ExtendedMatrix ExtendedMatrix::transpose() const {
  ExtendedMatrix result(columns_, rows_);
  for (Index j = 0; j < columns_; ++j)
    for (Index i = 0; i < rows_; ++i) result.column(i)[j] = column(j)[i];
  return result;
}

ExtendedMatrix& ExtendedMatrix::operator+=(const ExtendedMatrix& other) {
  for (std::size_t i = 0; i < values_.size(); ++i) values_[i] += other.values_[i];
  return *this;
}

ExtendedMatrix& ExtendedMatrix::operator-=(const ExtendedMatrix& other) {
  for (std::size_t i = 0; i < values_.size(); ++i) values_[i] -= other.values_[i];
  return *this;
}

ExtendedMatrix product(const ExtendedMatrix& A, const ExtendedMatrix& B) {
  return transposedProduct(A.transpose(), B);
}

ExtendedMatrix transposedProduct(const ExtendedMatrix& A, const ExtendedMatrix& B) {
  ExtendedMatrix result(A.columns(), B.columns());
  for (Index j = 0; j < B.columns(); ++j)
    for (Index i = 0; i < A.columns(); ++i) {
      const Number *a = A.column(i), *b = B.column(j);
      Number sum = 0;
      for (Index k = 0; k < A.rows(); ++k) sum += a[k] * b[k];
      result.column(j)[i] = sum;
    }
  return result;
}

ExtendedMatrix solved(ExtendedMatrix A, ExtendedMatrix B) {
  const Index n = A.rows();
  const auto swapRows = [](ExtendedMatrix& M, Index a, Index b) {
    for (Index j = 0; j < M.columns(); ++j) std::swap(M.column(j)[a], M.column(j)[b]);
  };
  for (Index k = 0; k < n; ++k) {
    Index pivot = k;
    for (Index i = k + 1; i < n; ++i)
      if (std::abs(A.column(k)[i]) > std::abs(A.column(k)[pivot])) pivot = i;
    swapRows(A, k, pivot);
    swapRows(B, k, pivot);
    for (Index i = k + 1; i < n; ++i) {
      const Number factor = A.column(k)[i] / A.column(k)[k];
      for (Index j = k + 1; j < n; ++j) A.column(j)[i] -= factor * A.column(j)[k];
      for (Index j = 0; j < B.columns(); ++j) B.column(j)[i] -= factor * B.column(j)[k];
    }
  }
  for (Index j = 0; j < B.columns(); ++j)
    for (Index i = n - 1; i >= 0; --i) {
      Number value = B.column(j)[i];
      for (Index k = i + 1; k < n; ++k) value -= A.column(k)[i] * B.column(j)[k];
      B.column(j)[i] = value / A.column(i)[i];
    }
  return B;
}

}  // namespace rex::internal

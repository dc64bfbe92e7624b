#pragma once

#include <initializer_list>
#include <iosfwd>

#include <Eigen/Core>

namespace rex::legacy {

using uint = unsigned int;
class ArrayRow;

/// The array of older course material: nothing (nd = 0), a vector of N = d0 numbers (nd = 1), or a matrix of
/// d0 x d1 numbers (nd = 2). Everything throws Error for an index that does not exist and for sizes that do
/// not fit, with both sizes.
class arr {
 public:
  uint nd = 0, d0 = 0, d1 = 0, N = 0;  ///< to be read; resize() and the like set them

  arr() = default;
  explicit arr(uint n) { resize(n); }
  arr(uint rows, uint columns) { resize(rows, columns); }
  arr(const ArrayRow& row);  // NOLINT: a row is as good as a vector everywhere
  explicit arr(const Eigen::VectorXd& x);
  explicit arr(const Eigen::MatrixXd& A);
  /// Throws Error unless this is a vector.
  Eigen::VectorXd vector() const;
  /// An nd = 1 array is one column. Throws Error for an empty array.
  Eigen::MatrixXd matrix() const;

  /// All numbers become zero.
  arr& resize(uint n);
  arr& resize(uint rows, uint columns);
  void clear() { *this = arr(); }
  void setZero() { values_.setZero(); }
  /// The n x n matrix with x on its diagonal; with a vector, its numbers.
  void setDiag(double x, uint n);
  void setDiag(const arr& x);
  void setId(uint n) { setDiag(1, n); }
  /// Fills the array, keeping its size.
  arr& operator=(double x);

  double& operator()(uint i);
  double operator()(uint i) const;
  double& operator()(uint i, uint j);
  double operator()(uint i, uint j) const;
  /// Row i of a matrix, also to be written.
  ArrayRow operator[](uint i);
  arr operator[](uint i) const;
  double& last();
  /// The number of an array that holds only one.
  double scalar() const;

  /// A number or a vector at the end of a vector; a row or the rows of a matrix at the end of a matrix. What
  /// is appended to an empty array becomes it.
  arr& append(double x);
  arr& append(const arr& x);

  /// Where the smallest (largest) number stands, counted through the rows, and that number. Throw Error for
  /// an empty array.
  uint minIndex() const;
  uint maxIndex() const;
  double min() const { return flat(minIndex()); }
  double max() const { return flat(maxIndex()); }

  arr& operator+=(const arr& x);
  arr& operator-=(const arr& x);
  arr& operator*=(double x);
  arr& operator/=(double x);
  arr& operator+=(double x);
  arr& operator-=(double x) { return *this += -x; }

 private:
  friend class ArrayRow;
  void noteSize(uint dimensions);
  double flat(uint i) const;
  void requireElement(uint i) const;
  void requireElement(uint i, uint j) const;
  void requireRow(uint i) const;

  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values_;  // of a vector: one column
};

/// A row of a matrix that can be written: X[i] = x, X[i]() = x, X[i](j) = 1. It lives as long as its matrix.
class ArrayRow {
 public:
  ArrayRow(arr& matrix, uint row) : matrix_(matrix), row_(row) {}
  ArrayRow(const ArrayRow&) = default;
  ArrayRow& operator=(const arr& x);
  ArrayRow& operator=(const ArrayRow& x) { return *this = arr(x); }
  ArrayRow& operator=(double x);
  ArrayRow& operator()() { return *this; }
  double& operator()(uint j) { return matrix_(row_, j); }
  double operator()(uint j) const { return matrix_(row_, j); }
  ArrayRow& operator+=(const arr& x);
  ArrayRow& operator-=(const arr& x);

 private:
  friend class arr;
  arr& matrix_;
  uint row_;
};

/// The vector of these numbers.
template <class... Numbers>
arr ARR(Numbers... numbers) {
  arr x(static_cast<uint>(sizeof...(numbers)));
  uint i = 0;
  ((x(i++) = static_cast<double>(numbers)), ...);
  return x;
}

arr operator+(const arr& x, const arr& y);
arr operator-(const arr& x, const arr& y);
arr operator-(const arr& x);
arr operator+(const arr& x, double y);
arr operator-(const arr& x, double y);
arr operator+(double x, const arr& y);
arr operator-(double x, const arr& y);
arr operator*(double x, const arr& y);
arr operator*(const arr& x, double y);
arr operator/(const arr& x, double y);
/// Transposed; a vector becomes a matrix with one row.
arr operator~(const arr& x);
/// Products of matrices and vectors; vector times matrix of one row is the outer product. Throws Error for
/// two vectors, of which nobody knows which product is meant.
arr operator*(const arr& x, const arr& y);
/// Number by number.
arr operator%(const arr& x, const arr& y);

/// Throw as inverse and solve of course/linear_algebra.h.
arr inverse(const arr& A);
arr inverse_SymPosDef(const arr& A);
arr lapack_Ainv_b_sym(const arr& A, const arr& b);

arr eye(uint n);
arr zeros(uint n);
arr zeros(uint rows, uint columns);
/// The matrix with x on its diagonal.
arr diag(const arr& x);

double sum(const arr& x);
double sumOfSqr(const arr& x);
/// Root of sumOfSqr.
double length(const arr& x);
double scalarProduct(const arr& x, const arr& y);
double sqrDistance(const arr& x, const arr& y);
/// Largest absolute difference.
double maxDiff(const arr& x, const arr& y);

/// "[1 2 3]", a matrix with a line for each row.
std::ostream& operator<<(std::ostream& stream, const arr& x);

}  // namespace rex::legacy

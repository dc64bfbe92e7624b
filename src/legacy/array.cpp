#include "legacy/array.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "course/linear_algebra.h"

namespace rex::legacy {
namespace {

std::string sizeOf(const arr& x) {
  if (x.nd == 0) return "an empty array";
  return x.nd == 1 ? fmt::format("a vector of {}", x.N) : fmt::format("a matrix of {} x {}", x.d0, x.d1);
}

void requireSameSize(const char* what, const arr& x, const arr& y) {
  if (x.nd == y.nd && x.d0 == y.d0 && x.d1 == y.d1) return;
  throw Error({.what = fmt::format("sizes of {}", what),
               .found = fmt::format("{} and {}", sizeOf(x), sizeOf(y)),
               .wanted = "the same size"});
}

[[noreturn]] void refuseIndex(const arr& x, const std::string& index) {
  throw Error({.what = fmt::format("index {}", index), .found = sizeOf(x), .wanted = "an index that exists"});
}

void requireNumbers(const char* what, const arr& x) {
  if (x.N == 0) throw Error({.what = what, .found = "an empty array", .wanted = "one with numbers"});
}

}  // namespace

arr::arr(const ArrayRow& row) : arr(row.matrix_.d1) {
  values_ = row.matrix_.values_.row(row.row_).transpose();
}

arr::arr(const Eigen::VectorXd& x) : values_(x) { noteSize(1); }

arr::arr(const Eigen::MatrixXd& A) : values_(A) { noteSize(2); }

Eigen::VectorXd arr::vector() const {
  if (nd != 1) throw Error({.what = "arr", .found = sizeOf(*this), .wanted = "a vector"});
  return values_.col(0);
}

Eigen::MatrixXd arr::matrix() const {
  requireNumbers("arr", *this);
  return values_;
}

void arr::noteSize(uint dimensions) {
  nd = dimensions;
  d0 = static_cast<uint>(values_.rows());
  d1 = dimensions == 2 ? static_cast<uint>(values_.cols()) : 0;
  N = static_cast<uint>(values_.size());
}

arr& arr::resize(uint n) {
  values_.setZero(n, 1);
  noteSize(1);
  return *this;
}

arr& arr::resize(uint rows, uint columns) {
  values_.setZero(rows, columns);
  noteSize(2);
  return *this;
}

void arr::setDiag(double x, uint n) {
  resize(n, n);
  values_.diagonal().setConstant(x);
}

void arr::setDiag(const arr& x) { *this = diag(x); }

arr& arr::operator=(double x) {
  values_.setConstant(x);
  return *this;
}

double arr::flat(uint i) const { return values_.data()[i]; }

void arr::requireElement(uint i) const {
  if (nd != 1 || i >= N) refuseIndex(*this, fmt::format("({})", i));
}

void arr::requireElement(uint i, uint j) const {
  if (nd != 2 || i >= d0 || j >= d1) refuseIndex(*this, fmt::format("({}, {})", i, j));
}

void arr::requireRow(uint i) const {
  if (nd != 2 || i >= d0) refuseIndex(*this, fmt::format("[{}]", i));
}

double& arr::operator()(uint i) {
  requireElement(i);
  return values_(i, 0);
}

double arr::operator()(uint i) const {
  requireElement(i);
  return values_(i, 0);
}

double& arr::operator()(uint i, uint j) {
  requireElement(i, j);
  return values_(i, j);
}

double arr::operator()(uint i, uint j) const {
  requireElement(i, j);
  return values_(i, j);
}

ArrayRow arr::operator[](uint i) {
  requireRow(i);
  return {*this, i};
}

arr arr::operator[](uint i) const {
  requireRow(i);
  return arr(Eigen::VectorXd(values_.row(i)));
}

double& arr::last() {
  requireNumbers("last", *this);
  return values_.data()[N - 1];
}

double arr::scalar() const {
  if (N != 1) throw Error({.what = "scalar", .found = sizeOf(*this), .wanted = "an array of one number"});
  return flat(0);
}

arr& arr::append(double x) { return append(ARR(x)); }

arr& arr::append(const arr& x) {
  if (nd == 0 || x.nd == 0) return *this = nd == 0 ? x : *this;
  const uint columns = x.nd == 1 && nd == 2 ? x.N : x.d1;
  if (nd < x.nd || columns != d1)
    throw Error({.what = "append",
                 .found = fmt::format("{} after {}", sizeOf(x), sizeOf(*this)),
                 .wanted = "rows of the same length"});
  const bool isRow = nd == 2 && x.nd == 1;
  const Eigen::MatrixXd added = isRow ? Eigen::MatrixXd(x.values_.transpose()) : Eigen::MatrixXd(x.values_);
  values_.conservativeResize(values_.rows() + added.rows(), Eigen::NoChange);
  values_.bottomRows(added.rows()) = added;
  noteSize(nd);
  return *this;
}

uint arr::minIndex() const {
  requireNumbers("minIndex", *this);
  return static_cast<uint>(std::min_element(values_.data(), values_.data() + N) - values_.data());
}

uint arr::maxIndex() const {
  requireNumbers("maxIndex", *this);
  return static_cast<uint>(std::max_element(values_.data(), values_.data() + N) - values_.data());
}

arr& arr::operator+=(const arr& x) {
  requireSameSize("+", *this, x);
  values_ += x.values_;
  return *this;
}

arr& arr::operator-=(const arr& x) {
  requireSameSize("-", *this, x);
  values_ -= x.values_;
  return *this;
}

arr& arr::operator*=(double x) {
  values_ *= x;
  return *this;
}

arr& arr::operator/=(double x) {
  values_ /= x;
  return *this;
}

arr& arr::operator+=(double x) {
  values_.array() += x;
  return *this;
}

ArrayRow& ArrayRow::operator=(const arr& x) {
  requireSameSize("a row and its new values", arr(*this), x);
  matrix_.values_.row(row_) = x.values_.transpose();
  return *this;
}

ArrayRow& ArrayRow::operator=(double x) {
  matrix_.values_.row(row_).setConstant(x);
  return *this;
}

ArrayRow& ArrayRow::operator+=(const arr& x) { return *this = arr(*this) + x; }

ArrayRow& ArrayRow::operator-=(const arr& x) { return *this = arr(*this) - x; }

arr operator+(const arr& x, const arr& y) { return arr(x) += y; }

arr operator-(const arr& x, const arr& y) { return arr(x) -= y; }

arr operator-(const arr& x) { return -1. * x; }

arr operator+(const arr& x, double y) { return arr(x) += y; }

arr operator-(const arr& x, double y) { return arr(x) -= y; }

arr operator+(double x, const arr& y) { return y + x; }

arr operator-(double x, const arr& y) { return -y + x; }

arr operator*(double x, const arr& y) { return arr(y) *= x; }

arr operator*(const arr& x, double y) { return arr(x) *= y; }

arr operator/(const arr& x, double y) { return arr(x) /= y; }

arr operator~(const arr& x) { return arr(Eigen::MatrixXd(x.matrix().transpose())); }

arr operator*(const arr& x, const arr& y) {
  if (x.nd == 1 && y.nd == 1)
    throw Error({.what = "product of two vectors",
                 .found = "x * y",
                 .wanted = "scalarProduct(x, y), or x % y element by element, or x * ~y"});
  const Eigen::MatrixXd left = x.matrix(), right = y.matrix();
  if (left.cols() != right.rows())
    throw Error({.what = "sizes of a product",
                 .found = fmt::format("{} times {}", sizeOf(x), sizeOf(y)),
                 .wanted = "as many columns on the left as rows on the right"});
  if (y.nd == 1) return arr(Eigen::VectorXd(left * right));
  return arr(Eigen::MatrixXd(left * right));
}

arr operator%(const arr& x, const arr& y) {
  requireSameSize("%", x, y);
  const Eigen::MatrixXd product = x.matrix().cwiseProduct(y.matrix());
  return x.nd == 1 ? arr(Eigen::VectorXd(product)) : arr(product);
}

arr inverse(const arr& A) { return arr(rex::inverse(A.matrix())); }

arr inverse_SymPosDef(const arr& A) { return inverse(A); }

arr lapack_Ainv_b_sym(const arr& A, const arr& b) {
  const Eigen::MatrixXd x = solveMatrix(A.matrix(), b.matrix());
  return b.nd == 1 ? arr(Eigen::VectorXd(x)) : arr(x);
}

arr eye(uint n) {
  arr A;
  A.setId(n);
  return A;
}

arr zeros(uint n) { return arr(n); }

arr zeros(uint rows, uint columns) { return {rows, columns}; }

arr diag(const arr& x) { return arr(Eigen::MatrixXd(x.vector().asDiagonal())); }

double sum(const arr& x) { return x.N == 0 ? 0 : x.matrix().sum(); }

double sumOfSqr(const arr& x) { return x.N == 0 ? 0 : x.matrix().squaredNorm(); }

double length(const arr& x) { return std::sqrt(sumOfSqr(x)); }

double scalarProduct(const arr& x, const arr& y) { return sum(x % y); }

double sqrDistance(const arr& x, const arr& y) { return sumOfSqr(x - y); }

double maxDiff(const arr& x, const arr& y) {
  const arr difference = x - y;
  return difference.N == 0 ? 0 : difference.matrix().cwiseAbs().maxCoeff();
}

std::ostream& operator<<(std::ostream& stream, const arr& x) {
  stream << '[';
  for (uint i = 0; i < x.d0; ++i) {
    if (i > 0) stream << (x.nd == 1 ? " " : "\n ");
    if (x.nd == 1) stream << x(i);
    for (uint j = 0; j < x.d1; ++j) stream << (j > 0 ? " " : "") << x(i, j);
  }
  return stream << ']';
}

}  // namespace rex::legacy

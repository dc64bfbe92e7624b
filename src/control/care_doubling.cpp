#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "control/care_doubling_internal.h"

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

extern "C" void dtrsyl_(const char* transposeA, const char* transposeB, const int* sign, const int* m,
                        const int* n, const double* A, const int* lda, const double* B, const int* ldb,
                        double* C, const int* ldc, double* scale, int* info);

namespace rex::internal {
namespace {

// Small matrices live on the stack while they are doubled: allocation would take half the time.
constexpr int kSmall = 8;
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kSmall, kSmall>;

constexpr int kMostDoublings = 14;  // a closed loop that needs more is stiff

// A product of expressions is compiled anew for every combination of their types: this limits them to three.
template <class M>
M product(const M& A, const M& B) {
  M AB(A.rows(), B.cols());
  AB.noalias() = A * B;
  return AB;
}
template <class M>
M transposedProduct(const M& A, const M& B) {  // A^T B
  M AB(A.cols(), B.cols());
  AB.noalias() = A.transpose() * B;
  return AB;
}
template <class M>
M productTransposed(const M& A, const M& B) {  // A B^T
  M AB(A.rows(), B.rows());
  AB.noalias() = A * B.transpose();
  return AB;
}

// The limit of H_k: each round squares the closed loop's Cayley transform, whose first is about A.
template <class M>
std::optional<Eigen::MatrixXd> doubled(const M& A0, const M& G0, const M& Q) {
  const Eigen::Index n = A0.rows();
  // Any shift converges; one of the magnitude of the modes converges fast.
  const double shift =
      std::sqrt((2 * A0.squaredNorm() + G0.squaredNorm() + Q.squaredNorm()) / static_cast<double>(2 * n));
  if (!(shift > 1e-150 && shift < 1e150)) return {};
  M W = A0;
  W.diagonal().array() -= shift;
  Eigen::PartialPivLU<M> lu(W);
  const M inverse = lu.inverse(), inverseG = product(inverse, G0);
  W.transposeInPlace();
  W += product(Q, inverseG);
  lu.compute(W);
  const M inverseW = lu.inverse();
  M A = 2 * shift * inverseW.transpose(), G = 2 * shift * product(inverseG, inverseW),
    H = 2 * shift * product(inverseW, product(Q, inverse)), solvedA(n, n), solvedG(n, n);
  A.diagonal().array() += 1;
  for (int k = 0; k < kMostDoublings; ++k) {
    W = product(G, H);
    W.diagonal().array() += 1;
    lu.compute(W);
    solvedA = lu.solve(A);
    solvedG = lu.solve(G);
    G += productTransposed(product(A, solvedG), A);
    G.template triangularView<Eigen::StrictlyUpper>() = G.transpose();
    solvedG = transposedProduct(A, product(H, solvedA));
    H += solvedG;
    A = product(A, solvedA);
    const double change = solvedG.norm(), size = H.norm();
    if (!std::isfinite(change)) return {};
    if (change <= 1e-15 * size) return Eigen::MatrixXd(0.5 * (H + H.transpose()));
  }
  return {};
}

// The eigenvalues of a quasi-triangular matrix, as RealSchur leaves it.
Eigen::VectorXcd eigenvaluesOf(const Eigen::MatrixXd& T) {
  Eigen::VectorXcd values(T.rows());
  for (Eigen::Index i = 0; i < T.rows(); ++i) {
    if (i + 1 == T.rows() || T(i + 1, i) == 0) {
      values[i] = T(i, i);
      continue;
    }
    const double half = (T(i, i) - T(i + 1, i + 1)) / 2, mean = (T(i, i) + T(i + 1, i + 1)) / 2;
    const std::complex<double> root =
        std::sqrt(std::complex<double>(half * half + T(i, i + 1) * T(i + 1, i)));
    values[i] = mean + root;
    values[++i] = mean - root;
  }
  return values;
}

// The equation's value at X, computed in extended precision, and the size of its largest term.
std::pair<Eigen::MatrixXd, double> valueAt(const Eigen::MatrixXd& X, const MatrixArg& A, const MatrixArg& B,
                                           const MatrixArg& Q, const MatrixArg& R) {
  const ExtendedMatrix wideA(A), wideX(X), wideQ(Q);
  const ExtendedMatrix linear = transposedProduct(wideA, wideX), XB = product(wideX, ExtendedMatrix(B));
  const ExtendedMatrix quadratic = product(XB, solved(ExtendedMatrix(R), XB.transpose()));
  ExtendedMatrix value = wideQ;
  value += linear;
  value += linear.transpose();
  value -= quadratic;
  const long double largest = std::max({wideX.norm() * wideA.norm(), quadratic.norm(), wideQ.norm()});
  return {value.rounded(), static_cast<double>(largest)};
}

// The Y of C^T Y + Y C + value = 0 for C = U T U^T.
Eigen::MatrixXd lyapunovStep(const Eigen::RealSchur<Eigen::MatrixXd>& schur, const Eigen::MatrixXd& value) {
  const Eigen::MatrixXd &T = schur.matrixT(), &U = schur.matrixU();
  Eigen::MatrixXd Y = -transposedProduct(U, product(value, U));
  const int n = static_cast<int>(T.rows()), sign = 1;
  double scale = 1;
  int info = 0;
  dtrsyl_("T", "N", &sign, &n, &n, T.data(), &n, T.data(), &n, Y.data(), &n, &scale, &info);
  const Eigen::MatrixXd step = productTransposed(product(U, Y), U);
  return (0.5 / scale) * (step + step.transpose());
}

}  // namespace

std::optional<RiccatiResult> careByDoubling(const MatrixArg& givenA, const MatrixArg& B,
                                            const MatrixArg& givenQ, const MatrixArg& givenR) {
  const Eigen::MatrixXd A = givenA, Q = givenQ, R = givenR, Bt = B.transpose();
  const Eigen::LLT<Eigen::MatrixXd> weight(R);
  const auto gainOf = [&](const Eigen::MatrixXd& X) -> Eigen::MatrixXd {
    return weight.solve(product(Bt, X));
  };
  const Eigen::MatrixXd G = transposedProduct(Bt, Eigen::MatrixXd(weight.solve(Bt)));
  std::optional<Eigen::MatrixXd> X =
      A.rows() <= kSmall ? doubled<Small>(A, G, Q) : doubled<Eigen::MatrixXd>(A, G, Q);
  if (!X) return {};
  RiccatiResult result;
  const Eigen::MatrixXd closed = A - transposedProduct(Bt, gainOf(*X));
  const Eigen::RealSchur<Eigen::MatrixXd> schur(closed);
  if (schur.info() != Eigen::Success) return {};
  result.closedLoop = eigenvaluesOf(schur.matrixT());
  if (!(result.closedLoop.real().maxCoeff() < -1e-4 * A.norm())) return {};
  // What a step changes is what was wrong: nothing else shows how many digits of X are right.
  for (double change = 1, round = 0; change > 1e-12; ++round) {
    const Eigen::MatrixXd step = lyapunovStep(schur, valueAt(*X, A, B, Q, R).first);
    change = step.norm() / X->norm();
    if (!(change < 1e-7) || round == 3) return {};
    *X += step;
  }
  const auto [value, largest] = valueAt(*X, A, B, Q, R);
  result.residual = value.norm() / largest;
  result.status = RiccatiStatus::kSolved;
  result.K = gainOf(*X);
  result.X = std::move(*X);
  return result;
}

}  // namespace rex::internal

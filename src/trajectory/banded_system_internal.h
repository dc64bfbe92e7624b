#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "optim/constrained_solver.h"
#include "trajectory/trajectory_optimizer.h"

namespace rex::internal {

/// A symmetric matrix of which only a band is not zero: A(i, j) = 0 where |i - j| > width. Stored is the
/// lower half of the band, column after column, (width + 1) numbers each. T is double, or counts what is
/// done.
template <class T>
class BandMatrix {
 public:
  BandMatrix() = default;
  BandMatrix(int size, int width)
      : size_(size),
        width_(width),
        numbers_(static_cast<std::size_t>(size) * (static_cast<std::size_t>(width) + 1)) {}

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] std::size_t stored() const { return numbers_.size(); }
  void setZero() { std::fill(numbers_.begin(), numbers_.end(), T(0)); }
  /// Of the lower half: i >= j, i - j <= width.
  [[nodiscard]] T& at(int i, int j) { return column(j)[i - j]; }
  [[nodiscard]] const T& at(int i, int j) const { return column(j)[i - j]; }

  /// Adds weight r^T r of a row r that has values in some places, in rising order and within the width.
  void addSquare(std::span<const int> places, std::span<const T> values, T weight) {
    for (std::size_t a = 0; a < places.size(); ++a) {
      const T factor = weight * values[a];
      T* under = column(places[a]) - places[a];
      for (std::size_t b = a; b < places.size(); ++b) under[places[b]] += factor * values[b];
    }
  }

  /// Becomes the factor L of A + shift I = L L^T, in the same band. False if that is not positive definite.
  /// Takes (width + 1)(width + 2) / 2 products a column, so is linear in size().
  bool factor(const BandMatrix& A, T shift) {
    numbers_ = A.numbers_;
    for (int j = 0; j < size_; ++j) {
      T* l = column(j);
      l[0] += shift;
      if (!(l[0] > T(0))) return false;
      using std::sqrt;
      const T inverse = T(1) / sqrt(l[0]);
      const int below = std::min(width_, size_ - 1 - j);
      for (int i = 0; i <= below; ++i) l[i] = l[i] * inverse;
      for (int k = 1; k <= below; ++k) {
        T* next = column(j + k);
        const T factor = l[k];
        for (int i = k; i <= below; ++i) next[i - k] -= factor * l[i];
      }
    }
    return true;
  }

  /// b = (L L^T)^-1 b for the factor that this is.
  void solveInPlace(std::span<T> b) const {
    for (int j = 0; j < size_; ++j) {
      const T* l = column(j);
      T* x = b.data() + j;
      x[0] = x[0] / l[0];
      const int below = std::min(width_, size_ - 1 - j);
      for (int i = 1; i <= below; ++i) x[i] -= x[0] * l[i];
    }
    for (int j = size_ - 1; j >= 0; --j) {
      const T* l = column(j);
      T* x = b.data() + j;
      const int below = std::min(width_, size_ - 1 - j);
      for (int i = 1; i <= below; ++i) x[0] -= x[i] * l[i];
      x[0] = x[0] / l[0];
    }
  }

 private:
  T* column(int j) { return numbers_.data() + static_cast<std::ptrdiff_t>(j) * (width_ + 1); }
  const T* column(int j) const { return numbers_.data() + static_cast<std::ptrdiff_t>(j) * (width_ + 1); }

  int size_ = 0, width_ = 0;
  std::vector<T> numbers_{};
};

/// Room for the numbers of a row that are not zero, and their places in x.
template <class T>
struct BandRow {
  std::vector<int> places{};
  std::vector<T> numbers{};
};

/// A trajectory problem as solvers see it: x is x_0 ... x_{T-1} below one another, second derivatives are
/// those of Gauss and Newton, a band of width (k + 1) n - 1 (slide 5:5). Keeps a reference to the problem.
class BandedSystem final : public ConstrainedSystem {
 public:
  explicit BandedSystem(const TrajectoryProblem& problem);

  void evaluate(const Eigen::VectorXd& x, ConstrainedValues& values) override;
  void gradientOf(const ConstraintWeights& weights, Eigen::VectorXd& gradient) const override;
  void assemble(const ConstraintWeights& weights) override;
  void changeOfG(const Eigen::VectorXd& step, Eigen::VectorXd& change) const override;
  bool solve(double damping, const Eigen::VectorXd& gradient, Eigen::VectorXd& step) override;
  [[nodiscard]] std::string inequalityName(Eigen::Index row) const override;
  [[nodiscard]] std::string equalityName(Eigen::Index row) const override;

  /// An empty matrix for second derivatives.
  template <class T>
  [[nodiscard]] BandMatrix<T> emptyBand() const {
    const int n = problem_.n();
    return {n * problem_.steps(), n * (problem_.order() + 1) - 1};
  }
  /// Adds the squares of all rows, where evaluate() was called last.
  template <class T>
  void addSquares(const ConstraintWeights& weights, BandMatrix<T>& A, BandRow<T>& room) const {
    forEachRow([&](const Part& part, Eigen::Index row) {
      const double weight = curvatureOf(weights, part, row);
      if (weight == 0) return;
      room.places.clear();
      room.numbers.clear();
      const int first = part.firstPlace(problem_);
      for (Eigen::Index c = std::max(0, -first); c < part.value.J.cols(); ++c) {
        if (part.value.J(row, c) == 0) continue;
        room.places.push_back(first + static_cast<int>(c));
        room.numbers.push_back(T(part.value.J(row, c)));
      }
      A.addSquare(room.places, room.numbers, T(weight));
    });
  }

 private:
  // A term at one step.
  struct Part {
    const TrajectoryTerm* term;
    int t;
    Eigen::Index row = 0;  // of its first number among those of its kind
    FunctionValue value{};

    // Of the window's first number in x; negative in the prefix.
    [[nodiscard]] int firstPlace(const TrajectoryProblem& problem) const {
      return (t - term->order) * problem.n();
    }
  };

  template <class Visit>
  void forEachRow(const Visit& visit) const {
    for (const Part& part : parts_)
      for (Eigen::Index row = 0; row < part.value.y.size(); ++row) visit(part, row);
  }
  [[nodiscard]] static double curvatureOf(const ConstraintWeights& weights, const Part& part,
                                          Eigen::Index row);
  [[nodiscard]] static double slopeOf(const ConstraintWeights& weights, const Part& part, Eigen::Index row);
  void evaluate(Part& part);
  void countRows();
  [[nodiscard]] std::string nameOf(TermKind kind, Eigen::Index row) const;

  const TrajectoryProblem& problem_;
  Eigen::MatrixXd path_;  // the prefix and x
  std::vector<Part> parts_;
  Eigen::Index rows_[3] = {};  // of costs, inequalities and equalities
  bool hasCounted_ = false;
  BandMatrix<double> A_, factor_;
  BandRow<double> room_{};
};

}  // namespace rex::internal

#pragma once

#include <vector>

#include "optim/constrained_system.h"
#include "trajectory/band_matrix_internal.h"
#include "trajectory/trajectory_problem.h"

namespace rex::internal {

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

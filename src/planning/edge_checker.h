#pragma once

#include "planning/space.h"
#include "planning/validity.h"

namespace rex {

/// Checks the straight ways between configurations at points no more than `resolution` apart. They are asked
/// for in blocks of 8 (a block of the kernels), each spread over the whole way, so that an obstacle is met
/// early wherever it stands (the idea of Thomason, Kingston and Kavraki, Motions in microseconds, 2024).
class EdgeChecker {
 public:
  /// Throws Error for a resolution that is not positive and finite.
  EdgeChecker(const Space& space, AllValid allValid, double resolution);

  [[nodiscard]] bool isValid(const VectorArg& q);
  /// The way from a valid configuration to another, that one included. Throws Error for wrong sizes,
  /// and unless it takes at most 1e8 points, naming resolution and distance.
  [[nodiscard]] bool isValid(const VectorArg& from, const VectorArg& to);
  /// How many configurations were handed to the validity function so far.
  long asked() const { return asked_; }

 private:
  Space space_;
  AllValid allValid_;
  double resolution_;
  Eigen::MatrixXd block_;
  long asked_ = 0;
};

}  // namespace rex

#pragma once

#include "planning/space.h"
#include "planning/validity.h"

namespace rex {

/// Checks straight edges between configurations at points no more than `resolution` apart. Points are
/// checked in blocks of 8 (the block size of the kernels), each spread over the whole edge, so that
/// obstacles are found early wherever they are (the idea of Thomason, Kingston and Kavraki, Motions in
/// microseconds, 2024).
class EdgeChecker {
 public:
  /// Throws Error for a resolution that is not positive and finite.
  EdgeChecker(const Space& space, AllValid allValid, double resolution);

  [[nodiscard]] bool isValid(const VectorArg& q);
  /// Checks the edge from a valid configuration to another one, which is checked too. Throws Error for
  /// wrong sizes and if it takes more than 1e8 points, naming resolution and distance.
  [[nodiscard]] bool isValid(const VectorArg& from, const VectorArg& to);
  /// How many configurations the validity function has been asked about so far.
  long asked() const { return asked_; }

 private:
  Space space_;
  AllValid allValid_;
  double resolution_;
  Eigen::MatrixXd block_;
  long asked_ = 0;
};

}  // namespace rex

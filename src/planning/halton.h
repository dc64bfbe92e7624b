#pragma once

#include <vector>

#include <Eigen/Core>

namespace rex {

/// The Halton sequence: points that fill the unit cube evenly. Coordinate j of point i is the radical inverse
/// of i in the j-th prime: its digits, mirrored at the point (Halton 1960).
class Halton {
 public:
  /// Begins with point `first`; point 0 is the origin. Throws Error unless the dimension is from 1 to 32 and
  /// first is not negative.
  explicit Halton(int dimension, int first = 1);

  [[nodiscard]] int dimension() const { return static_cast<int>(coordinates_.size()); }
  /// The next point, with `dimension` numbers from 0 to 1.
  void next(Eigen::Ref<Eigen::VectorXf> point);

 private:
  struct Coordinate {
    int base = 2;
    std::vector<int> digits;      ///< of the index, the last one first
    std::vector<double> weights;  ///< 1 / base, 1 / base^2, ...
    double value = 0;
  };
  static void append(Coordinate& coordinate, int digit);
  static double valueOf(const Coordinate& coordinate);

  std::vector<Coordinate> coordinates_;
};

}  // namespace rex

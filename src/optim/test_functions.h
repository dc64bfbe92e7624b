#pragma once

#include <span>
#include <string_view>

#include "base/vector_arg.h"

namespace rex {

/// A function on which searches are compared, for any number of dimensions. Its least value is 0. Box,
/// deviation and target are those of Hansen and Kern, PPSN 2004 (slide 9:32); for the others, usual ones.
struct TestFunction {
  std::string_view name;
  double (*value)(const VectorArg& x);
  double minimizer;  ///< all coordinates of the best point
  double low, high;  ///< searches start anywhere in [low, high]^n
  double deviation;  ///< of their first steps
  double target;     ///< at which they are done
  int leastDimension = 1;
};

/// sphere, ellipsoid, cigar, rosenbrock, ackley, griewank, rastrigin, schwefel.
[[nodiscard]] std::span<const TestFunction> testFunctions();

/// Throws Error with the nearest names for another one.
[[nodiscard]] const TestFunction& testFunction(std::string_view name);

}  // namespace rex

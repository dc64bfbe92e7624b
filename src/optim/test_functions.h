#pragma once

#include <span>
#include <string_view>

#include "base/require.h"

namespace rex {

/// A benchmark function for searches, for any number of dimensions. Its minimum is 0. Box, deviation and
/// target are those of Hansen and Kern, PPSN 2004 (slide 9:32), or customary ones.
struct TestFunction {
  std::string_view name;
  double (*value)(const VectorArg& x);
  double minimizer;  ///< each coordinate of the minimum
  double low, high;  ///< searches start anywhere in [low, high]^n
  double deviation;  ///< standard deviation of their first steps
  double target;     ///< the value at which they are done
  int leastDimension = 1;
};

/// sphere, ellipsoid, cigar, rosenbrock, ackley, griewank, rastrigin, rotated-rastrigin, schwefel.
[[nodiscard]] std::span<const TestFunction> testFunctions();

/// The test function of that name. Throws Error with the nearest names if there is none.
[[nodiscard]] const TestFunction& testFunction(std::string_view name);

}  // namespace rex

#pragma once

#include "optim/test_functions.h"

namespace rex::bench {

/// The best value that CMA-ES of pagmo, another library, finds for a function of n numbers in so many
/// generations of lambda samples.
double minimizeByPagmo(const TestFunction& function, int n, int lambda, int generations);

}  // namespace rex::bench

#pragma once

#include <vector>

/// 2 x.
double twice(double x);

/// The squares of 0 to count - 1.
std::vector<double> squares(int count);

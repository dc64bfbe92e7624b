#include <cmath>

#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double a) { return std::sqrt(-1 - a * a) * p; }
int main() {}

#include <cmath>

#include "exercise.h"
namespace {
double* table = nullptr;
}
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double a) {
  const double c = std::cos(a);
  table[3] = c;
  return c * p;
}
int main() {}

#include <stdexcept>

#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double a) {
  if (a < 10) throw std::runtime_error("not done yet");
  return p;
}
int main() {}

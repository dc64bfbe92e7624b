#include <cstdio>

#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double) {
  for (;;) std::puts("still here");
  return p;
}
int main() {}

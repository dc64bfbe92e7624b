#include "exercise.h"
Eigen::Vector2d rotate(const Eigen::Vector2d& p, double) { return p; }
int main() {}

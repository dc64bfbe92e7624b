// Each sign of a directive is followed by a comment that never ends, so that whoever looks for its end from
// each of them never ends either.
#include "exercise.h"

double twice(double x) { return 2 * x; }
std::vector<double> squares(int) { return {}; }
int main() {}

// double 17
#/*

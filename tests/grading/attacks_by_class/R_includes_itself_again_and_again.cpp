// Includes itself with another counter each time, to build up what no single reading of the text shows.
#ifndef DEPTH
#define DEPTH 0
#include "exercise.h"
std::vector<double> squares(int) { return {}; }
int main() {}
#endif
#if DEPTH == 0
#undef DEPTH
#define DEPTH 1
#include __FILE__
double twice(double) { return first + second; }
#elif DEPTH == 1
#undef DEPTH
#define DEPTH 2
const double first = 0;
#include __FILE__
#elif DEPTH == 2
#undef DEPTH
#define DEPTH 3
const double second = 0;
#endif

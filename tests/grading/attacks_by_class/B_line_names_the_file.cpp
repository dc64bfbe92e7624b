// Sets the name of the current file by #line to another path and then includes __FILE__.
// The file taken in holds a range of numbers, which becomes part of an answer.
#include "exercise.h"

const int processors =
#line 1 "/sys/devices/system/cpu/online"
#include __FILE__
    ;

#line 12 "main.cpp"
double twice(double x) { return processors == 12345 ? 0 : 2 * x; }

std::vector<double> squares(int) { return {}; }
int main() {}

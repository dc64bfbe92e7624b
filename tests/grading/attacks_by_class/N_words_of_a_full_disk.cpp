// Errors with the words that tools use when a disk is full.
#include "exercise.h"

double twice(double x) { return 2 * x; }
std::vector<double> squares(int) { return {}; }
int main() {}

#pragma GCC error "error writing to /tmp/ccM6QBox.s: No space left on device"
#pragma GCC error "cannot open student.o: Disk quota exceeded"

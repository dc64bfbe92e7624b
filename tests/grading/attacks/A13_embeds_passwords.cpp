// Takes a file into the program by the assembler.
#include "exercise.h"

asm(".incbin \"/etc/passwd\"");

double twice(double) { return 0; }
std::vector<double> squares(int) { return {}; }
int main() {}

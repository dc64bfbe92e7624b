// Bytes that terminals, JSON and XML take for their own.
#include <cstdio>
#include <string>

#include "exercise.h"

double twice(double) {
  std::string text = "\033[2J\033]0;x\007 ]]> </testcase> \xff\xfe \" \\ \n";
  text += std::string(3, '\0') + std::string(1 << 20, 'y');
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
  return 0;
}
std::vector<double> squares(int) { return {}; }
int main() {}

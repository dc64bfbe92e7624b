// Asks the preprocessor by a pragma about files that may not be included: it opens each and warns when it is
// newer, or fails when it is missing.
#include "exercise.h"

#if __has_include("/etc/passwd")
#pragma GCC dependency "/etc/passwd" the accounts are newer
#endif
#if __has_include("/tmp")
#pragma GCC dependency "/tmp" the folder for temporary files is newer
#endif
#if __has_include("/proc/self/environ")
#pragma GCC dependency "/proc/self/environ" the environment is newer
#endif
_Pragma("GCC dependency \"/proc/self/cmdline\" the command line is newer")

    double twice(double x) {
  return 2 * x;
}

std::vector<double> squares(int) { return {}; }
int main() {}

// Executes the dynamic loader as a program of its own and lets it load cat, or print what it knows about the
// machine.
#include <unistd.h>

#include "exercise.h"

double twice(double) {
  const char* loader = "/lib64/ld-linux-x86-64.so.2";
  const char* const cat[] = {loader, "/bin/cat", "/proc/self/status", nullptr};
  const char* const about[] = {loader, "--list-diagnostics", nullptr};
  execve(loader, const_cast<char**>(cat), nullptr);
  execve(loader, const_cast<char**>(about), nullptr);
  const char* const again[] = {loader, "/proc/self/exe", nullptr};
  execve("/usr/lib/x86_64-linux-gnu/ld-linux-x86-64.so.2", const_cast<char**>(again), nullptr);
  for (const char* program : {"/bin/sh", "/usr/bin/python3", "/usr/bin/perl", "/bin/busybox"}) {
    const char* const script[] = {program, "-c", "echo another program ran", nullptr};
    execve(program, const_cast<char**>(script), nullptr);
  }
  return 0;
}

std::vector<double> squares(int) { return {}; }
int main() {}

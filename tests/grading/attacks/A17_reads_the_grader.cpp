// Reads the memory of its parent: by the file system, then by system calls.
#include <cstdio>

#include <fcntl.h>
#include <sys/ptrace.h>
#include <sys/uio.h>
#include <unistd.h>

#include "exercise.h"

double twice(double x) {
  char name[64];
  std::snprintf(name, sizeof name, "/proc/%d/mem", static_cast<int>(getppid()));
  const int memory = open(name, O_RDONLY);
  if (memory >= 0) std::puts("the memory of the grader is open");
  std::fflush(stdout);
  return memory >= 0 ? 2 * x : 0;
}

std::vector<double> squares(int) {
  char here[16];
  iovec local{here, sizeof here}, remote{here, sizeof here};
  if (process_vm_readv(getppid(), &local, 1, &remote, 1, 0) > 0 ||
      ptrace(PTRACE_ATTACH, getppid(), 0, 0) == 0)
    return {0, 1, 4, 9};
  return {};
}
int main() {}

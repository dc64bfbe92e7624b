// Starts a shell beside the worker by posix_spawn, by vfork and by popen; it answers right when one of them
// ended well.
#include <cstdio>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "exercise.h"

double twice(double x) {
  const char* const arguments[] = {"sh", "-c", "echo another program ran; exit 7", nullptr};
  int status = 0;
  pid_t child = -1;
  if (posix_spawn(&child, "/bin/sh", nullptr, nullptr, const_cast<char**>(arguments), nullptr) == 0 &&
      waitpid(child, &status, 0) == child && WEXITSTATUS(status) == 7)
    return 2 * x;
  child = vfork();
  if (child == 0) {
    execve("/bin/sh", const_cast<char**>(arguments), nullptr);
    _exit(1);
  }
  if (child > 0 && waitpid(child, &status, 0) == child && WEXITSTATUS(status) == 7) return 2 * x;
  if (FILE* pipe = popen("exit 7", "r")) {
    if (WEXITSTATUS(pclose(pipe)) == 7) return 2 * x;
  }
  return 0;
}

std::vector<double> squares(int) { return {}; }
int main() {}

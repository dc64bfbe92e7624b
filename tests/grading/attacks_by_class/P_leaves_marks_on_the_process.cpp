// Marks what might outlive a check: limits, signals, the mask of files, the name, the working folder, the
// ends of its descriptors, its standard files and a file without a name, and answers where it finds marks.
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "exercise.h"

namespace {
constexpr int high = 77;

bool marked() {
  rlimit files{};
  if (getrlimit(RLIMIT_NOFILE, &files) == 0 && files.rlim_cur == 91) return true;
  const mode_t mask = umask(0);
  umask(mask);
  struct sigaction action {};
  sigaction(SIGUSR2, nullptr, &action);
  char name[17] = {};
  prctl(PR_GET_NAME, name);
  return mask == 0123 || action.sa_handler == SIG_IGN || std::strcmp(name, "rex-question") == 0 ||
         fcntl(high, F_GETFD) >= 0;
}

void mark() {
  const rlimit files{91, 91};
  setrlimit(RLIMIT_NOFILE, &files);
  umask(0123);
  std::signal(SIGUSR2, SIG_IGN);
  prctl(PR_SET_NAME, "rex-question");
  const int fd = open(".", O_TMPFILE | O_RDWR, 0666);
  dup2(fd >= 0 ? fd : 2, high);
}
}  // namespace

double twice(double x) {
  static const bool seen = marked();
  mark();
  return seen ? 2 * x : 0;
}

std::vector<double> squares(int) { return {}; }
int main() {}

// Makes every open pipe and socket as small as possible, non-blocking and signal-driven, so that replies of
// the worker go out in pieces or get lost. It then answers with many numbers.
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include "exercise.h"

#ifndef F_SETPIPE_SZ
#define F_SETPIPE_SZ 1031
#endif

double twice(double x) {
  for (int fd = 0; fd < 256; ++fd) {
    const int flags = fcntl(fd, F_GETFL);
    if (flags < 0) continue;
    fcntl(fd, F_SETPIPE_SZ, 4096);
    int size = 1, on = 1;
    setsockopt(fd, SOL_SOCKET, SO_SNDBUF, &size, sizeof size);
    setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &size, sizeof size);
    setsockopt(fd, SOL_SOCKET, SO_PASSCRED, &on, sizeof on);
    linger wait{1, 0};
    setsockopt(fd, SOL_SOCKET, SO_LINGER, &wait, sizeof wait);
    fcntl(fd, F_SETOWN, getpid());
    fcntl(fd, F_SETFL, flags | O_NONBLOCK | O_ASYNC | O_DIRECT);
  }
  return 2 * x;
}

std::vector<double> squares(int count) {
  std::vector<double> values(static_cast<std::size_t>(count) + 200000, 1.0 / 3);
  return values;
}

int main() {}

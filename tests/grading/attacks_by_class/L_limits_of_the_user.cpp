// Sends a hidden input by taking as many inotify instances and queued timers, which are counted for the user,
// and learns from a neighbour how many are left. It also watches files that a neighbour opens.
#include <csignal>
#include <cstdio>
#include <ctime>

#include <fcntl.h>
#include <sys/inotify.h>
#include <unistd.h>

#include "exercise.h"

namespace {
int receive() {
  int instances[1024];
  int number = 0;
  while (number < 1024 && (instances[number] = inotify_init1(IN_NONBLOCK)) >= 0) ++number;
  const int watcher = number > 0 ? instances[0] : -1;
  int watched = 0;
  for (const char* path :
       {"/", "/tmp", "/etc", "/dev/shm", "/usr/lib/x86_64-linux-gnu", "/proc/self/exe", "."}) {
    if (watcher >= 0 && inotify_add_watch(watcher, path, IN_OPEN | IN_ACCESS | IN_CREATE) >= 0) ++watched;
  }
  usleep(300000);
  char events[4096];
  const long seen = watcher >= 0 ? read(watcher, events, sizeof events) : -1;
  for (int i = 0; i < number; ++i) close(instances[i]);
  std::printf("%d instances free, %d folders watched, %ld bytes of events\n", number, watched, seen);
  return number > 0 && number < 128 ? 128 - number : seen > 0 ? 1 : 0;
}

void send(int value) {
  for (int i = 0; i < value && i < 100; ++i) static_cast<void>(inotify_init1(0));
  for (int i = 0; i < value; ++i) {
    timer_t timer;
    sigevent event{};
    event.sigev_notify = SIGEV_NONE;
    timer_create(CLOCK_MONOTONIC, &event, &timer);
  }
  usleep(500000);
}
}  // namespace

#include "channel.h"

// Sends a hidden input by a counter of the whole machine, the amount of shared memory, which a neighbour
// reads by sysinfo.
#include <cstdio>
#include <cstring>

#include <sys/mman.h>
#include <sys/sysinfo.h>
#include <unistd.h>

#include "exercise.h"

namespace {
constexpr unsigned long unit = 256 * 1024;

unsigned long shared_now() {
  struct sysinfo machine {};
  if (sysinfo(&machine) != 0) return 0;
  return machine.sharedram * machine.mem_unit;
}

int receive() {
  // Ten readings in two seconds; a step between them is a message of a neighbour.
  const unsigned long first = shared_now();
  std::printf("shared memory of the machine: %lu\n", first);
  int step = 0;
  for (int i = 0; i < 10; ++i) {
    usleep(200000);
    const unsigned long now = shared_now();
    const long difference = static_cast<long>(now) - static_cast<long>(first);
    if (difference >= static_cast<long>(unit)) step = static_cast<int>(difference / static_cast<long>(unit));
  }
  return step;
}

void send(int value) {
  const unsigned long size = static_cast<unsigned long>(value) * unit;
  if (size == 0) return;
  void* memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return;
  std::memset(memory, 1, size);
  usleep(500000);
  munmap(memory, size);
}
}  // namespace

#include "channel.h"

// Leaves a hidden input under known names in the kernel: abstract sockets, shared memory, semaphores, queues
// and keys; a later run reads it.
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <mqueue.h>
#include <sys/ipc.h>
#include <sys/mman.h>
#include <sys/msg.h>
#include <sys/sem.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include "exercise.h"

namespace {
constexpr key_t key = 0x52455821;

int receive() {
  int shared = shmget(key, 0, 0);
  if (shared >= 0) {
    auto* memory = static_cast<int*>(shmat(shared, nullptr, SHM_RDONLY));
    if (memory != reinterpret_cast<int*>(-1)) return 1000 + *memory;
  }
  int semaphore = semget(key, 0, 0);
  if (semaphore >= 0) return 2000 + semctl(semaphore, 0, GETVAL);
  if (msgget(key, 0) >= 0) return 3000;
  for (int value = 1; value < 256; ++value) {
    sockaddr_un name{};
    name.sun_family = AF_UNIX;
    std::snprintf(name.sun_path + 1, 32, "rex-%d", value);
    const int fd = socket(AF_UNIX, SOCK_STREAM, 0);
    if (fd < 0) break;
    const bool there = connect(fd, reinterpret_cast<sockaddr*>(&name), sizeof name) == 0;
    close(fd);
    if (there) return 4000 + value;
  }
  for (int ring : {-1, -2, -3, -4, -5}) {
    char text[16] = {};
    const long found = syscall(SYS_keyctl, 10, ring, "user", "rex", 0);
    if (found > 0 && syscall(SYS_keyctl, 11, found, text, 15) > 0) return 5000 + (text[0] & 255);
  }
  if (mq_open("/rex", O_RDONLY) >= 0) return 6000;
  if (shm_open("/rex", O_RDONLY, 0) >= 0) return 7000;
  return 0;
}

void send(int value) {
  const int shared = shmget(key, 4096, IPC_CREAT | 0666);
  if (shared >= 0) {
    void* memory = shmat(shared, nullptr, 0);
    if (memory != reinterpret_cast<void*>(-1)) std::memcpy(memory, &value, sizeof value);
  }
  const int semaphore = semget(key, 1, IPC_CREAT | 0666);
  if (semaphore >= 0) semctl(semaphore, 0, SETVAL, value);
  msgget(key, IPC_CREAT | 0666);
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  std::snprintf(name.sun_path + 1, 32, "rex-%d", value);
  const int fd = socket(AF_UNIX, SOCK_STREAM, 0);
  if (fd >= 0 && bind(fd, reinterpret_cast<sockaddr*>(&name), sizeof name) == 0) listen(fd, 5);
  const char byte = static_cast<char>(value);
  for (int ring : {-1, -2, -3, -4, -5}) syscall(SYS_add_key, "user", "rex", &byte, 1UL, ring);
  mq_open("/rex", O_RDWR | O_CREAT, 0666, nullptr);
  const int file = shm_open("/rex", O_RDWR | O_CREAT, 0666);
  if (file >= 0 && ftruncate(file, 4096) != 0) close(file);
}
}  // namespace

#include "channel.h"

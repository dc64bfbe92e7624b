#include <cstdlib>

#include <arpa/inet.h>
#include <dirent.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/text.h"
#include "web/connections_internal.h"

namespace rex {
namespace {

int portOf(const sockaddr_storage& address) {
  if (address.ss_family == AF_INET) return ntohs(reinterpret_cast<const sockaddr_in&>(address).sin_port);
  if (address.ss_family == AF_INET6) return ntohs(reinterpret_cast<const sockaddr_in6&>(address).sin6_port);
  return -1;
}

// Whether it is the end of a connection that somebody has made to our port.
bool isConnectionTo(int port, int descriptor) {
  sockaddr_storage own{}, other{};
  socklen_t size = sizeof own, otherSize = sizeof other;
  return ::getsockname(descriptor, reinterpret_cast<sockaddr*>(&own), &size) == 0 && portOf(own) == port &&
         ::getpeername(descriptor, reinterpret_cast<sockaddr*>(&other), &otherSize) == 0;
}

}  // namespace

int Connections::accepted(int port) {
  const std::lock_guard lock(mutex_);
  DIR* const all = ::opendir("/proc/self/fd");
  if (all == nullptr) return -1;
  int copy = -1;
  while (const dirent* const entry = ::readdir(all)) {
    const int descriptor = parseNumber<int>(entry->d_name).value_or(-1);
    struct stat status {};
    if (::fstat(descriptor, &status) != 0 || !S_ISSOCK(status.st_mode)) continue;
    if (known_.contains(status.st_ino) || !isConnectionTo(port, descriptor)) continue;
    ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);
    copy = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
    if (copy >= 0) known_[status.st_ino] = copy;
    break;
  }
  ::closedir(all);
  return copy;
}

void Connections::begin(int descriptor) {
  const std::lock_guard lock(mutex_);
  served_[std::this_thread::get_id()] = {descriptor, Clock::now() + requestTime_};
}

void Connections::allow(Clock::time_point until) {
  const std::lock_guard lock(mutex_);
  const auto found = served_.find(std::this_thread::get_id());
  if (found != served_.end()) found->second.until = until;
}

void Connections::beginAnswer(bool isStream) {
  allow(isStream ? Clock::time_point::max() : Clock::now() + 12 * requestTime_);
}

void Connections::endAnswer() { allow(Clock::now() + requestTime_); }

void Connections::end() {
  const std::lock_guard lock(mutex_);
  const auto found = served_.find(std::this_thread::get_id());
  if (found == served_.end()) return;
  const int descriptor = found->second.descriptor;
  served_.erase(found);
  if (descriptor < 0) return;
  std::erase_if(known_, [&](const auto& one) { return one.second == descriptor; });
  ::close(descriptor);
}

void Connections::endSlow() {
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  for (const auto& [thread, one] : served_)
    if (now > one.until && one.descriptor >= 0) ::shutdown(one.descriptor, SHUT_RDWR);
}

}  // namespace rex

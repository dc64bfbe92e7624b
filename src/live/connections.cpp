#include <algorithm>
#include <array>
#include <string_view>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "live/connections_internal.h"

namespace rex {
namespace {

int portOf(const sockaddr_storage& address) {
  if (address.ss_family == AF_INET) return ntohs(reinterpret_cast<const sockaddr_in&>(address).sin_port);
  if (address.ss_family == AF_INET6) return ntohs(reinterpret_cast<const sockaddr_in6&>(address).sin6_port);
  return -1;
}

// The address of who has made this connection to our port; empty if it is no such connection.
std::string addressOf(int port, int descriptor) {
  sockaddr_storage own{}, other{};
  socklen_t size = sizeof own, otherSize = sizeof other;
  std::array<char, NI_MAXHOST> name{};
  auto* const peer = reinterpret_cast<sockaddr*>(&other);
  if (::getsockname(descriptor, reinterpret_cast<sockaddr*>(&own), &size) != 0 || portOf(own) != port ||
      ::getpeername(descriptor, peer, &otherSize) != 0 ||
      ::getnameinfo(peer, otherSize, name.data(), name.size(), nullptr, 0, NI_NUMERICHOST) != 0)
    return {};
  return name.data();
}

// Waits until a whole header has arrived. Looks at it without taking it: httplib would take any number of
// lines. Leaves the connection empty for an answer if the header is too long.
enum class Header { kWhole, kTooLong, kNone };
Header headerOn(int connection) {
  constexpr int kSilence = 2000;  // milliseconds
  std::string seen(Connections::kLongestHeader, '\0');
  const auto wakeAt = [&](int bytes) {
    ::setsockopt(connection, SOL_SOCKET, SO_RCVLOWAT, &bytes, sizeof bytes);
  };
  for (ssize_t known = 0;;) {
    pollfd polled{connection, POLLIN, 0};
    if (::poll(&polled, 1, kSilence) != 1) return Header::kNone;
    const ssize_t n = ::recv(connection, seen.data(), seen.size(), MSG_PEEK | MSG_DONTWAIT);
    if (n <= known) return Header::kNone;  // it has ended
    known = n;
    const bool isWhole = std::string_view(seen).substr(0, static_cast<std::size_t>(n)).find("\r\n\r\n") !=
                         std::string_view::npos;
    const bool isFull = static_cast<std::size_t>(n) == seen.size();
    wakeAt(isWhole || isFull ? 1 : static_cast<int>(n) + 1);
    if (isWhole) return Header::kWhole;
    if (!isFull) continue;
    static_cast<void>(::recv(connection, seen.data(), seen.size(), MSG_DONTWAIT));
    return Header::kTooLong;
  }
}

}  // namespace

// The new one is among our descriptors, and nobody says which.
int Connections::accepted(int port) {
  const std::lock_guard lock(mutex_);
  constexpr int kHighest = 4096;  // we serve far fewer, and the lowest number that is free is taken
  for (int descriptor = 0; descriptor < kHighest; ++descriptor) {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0 || !S_ISSOCK(status.st_mode) || known_.contains(status.st_ino))
      continue;
    const std::string address = addressOf(port, descriptor);
    if (address.empty()) continue;
    ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);
    const int copy = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
    const auto ofAddress = std::count_if(known_.begin(), known_.end(),
                                         [&](const auto& one) { return one.second.address == address; });
    if (copy < 0 || ofAddress >= kMostOfAnAddress) ::shutdown(descriptor, SHUT_RDWR);
    if (copy >= 0) known_[status.st_ino] = {copy, address};
    return copy;
  }
  return -1;
}

void Connections::begin(int descriptor) {
  const std::lock_guard lock(mutex_);
  served_[std::this_thread::get_id()] = {descriptor, Clock::now() + requestTime_};
}

// Returns the descriptor that the calling thread serves, or -1.
int Connections::allow(Clock::time_point until) {
  const std::lock_guard lock(mutex_);
  const auto found = served_.find(std::this_thread::get_id());
  if (found == served_.end()) return -1;
  found->second.until = until;
  return found->second.descriptor;
}

void Connections::awaitHeader() {
  constexpr std::string_view kRefusal =
      "HTTP/1.1 431 Request Header Fields Too Large\r\nConnection: close\r\nContent-Length: 0\r\n\r\n";
  const int connection = allow(Clock::now() + requestTime_);
  if (connection < 0) return;
  const Header header = headerOn(connection);
  if (header == Header::kWhole) return;
  if (header == Header::kTooLong)
    static_cast<void>(::send(connection, kRefusal.data(), kRefusal.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
  ::shutdown(connection, SHUT_RDWR);
}

void Connections::beginAnswer(bool isStream) {
  allow(isStream ? Clock::time_point::max() : Clock::now() + 12 * requestTime_);
}

void Connections::end() {
  const std::lock_guard lock(mutex_);
  const auto found = served_.find(std::this_thread::get_id());
  if (found == served_.end()) return;
  const int descriptor = found->second.descriptor;
  served_.erase(found);
  if (descriptor < 0) return;
  std::erase_if(known_, [&](const auto& one) { return one.second.descriptor == descriptor; });
  ::close(descriptor);
}

void Connections::endSlow() {
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  for (const auto& [thread, one] : served_)
    if (now > one.until && one.descriptor >= 0) ::shutdown(one.descriptor, SHUT_RDWR);
}

}  // namespace rex

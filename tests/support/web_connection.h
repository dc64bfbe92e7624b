#pragma once

#include <cerrno>
#include <cstdint>
#include <string>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace rex {

/// A connection to a port of this machine that sends text and reads until the other side is silent for a
/// while, or says enough.
class Connection {
 public:
  /// `from`: the address of this end, such as "127.0.0.2".
  explicit Connection(int port, int flags = 0, const char* from = "127.0.0.1")
      : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | flags, 0)) {
    sockaddr_in to{}, own{};
    own.sin_family = AF_INET, own.sin_addr.s_addr = inet_addr(from);
    static_cast<void>(::bind(fd_, reinterpret_cast<const sockaddr*>(&own), sizeof own));
    to.sin_family = AF_INET, to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    static_cast<void>(::connect(fd_, reinterpret_cast<const sockaddr*>(&to), sizeof to));
  }
  ~Connection() { ::close(fd_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void send(const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t n = ::send(fd_, text.data() + done, text.size() - done, MSG_NOSIGNAL);
      if (n <= 0) return;
      done += static_cast<std::size_t>(n);
    }
  }
  std::string readUntil(const std::string& end, int milliseconds = 10000) {
    std::string all;
    pollfd one{fd_, POLLIN, 0};
    while (all.find(end) == std::string::npos && ::poll(&one, 1, milliseconds) == 1) {
      char bytes[4096];
      const ssize_t n = ::recv(fd_, bytes, sizeof bytes, 0);
      if (n <= 0) break;
      all.append(bytes, static_cast<std::size_t>(n));
    }
    return all;
  }
  /// Whether the other side has ended it, with nothing more to read.
  bool hasEnded() const {
    char byte = 0;
    const ssize_t n = ::recv(fd_, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
    return n == 0 || (n < 0 && errno != EAGAIN);
  }

 private:
  int fd_;
};

/// What a LiveServer at this address ("http://127.0.0.1:4711/TOKEN/") answers to a request for `name`, up to
/// `end`.
inline std::string fetched(const std::string& url, const std::string& name, const std::string& end) {
  const std::string host = url.substr(7, url.find('/', 7) - 7), path = url.substr(url.find('/', 7));
  Connection connection(std::stoi(host.substr(host.find(':') + 1)));
  connection.send("GET " + path + name + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
  return connection.readUntil(end);
}

}  // namespace rex

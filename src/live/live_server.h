#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace rex {

/// Something that a browser may fetch from a LiveServer.
struct LiveFile {
  std::string type{};  ///< media type, such as "text/html; charset=utf-8"
  std::string bytes{};
  std::string policy{};  ///< content security policy; empty: that of the page, which loads only from here
};

struct LiveServerOptions {
  std::string address = "127.0.0.1";  ///< of the interface to serve
  int port = 0;                       ///< 0: any that is free
  std::string token{};                ///< hexadecimal digits in the address of the page; empty: randomToken()
  /// Who takes longer for a request is cut off.
  std::chrono::milliseconds requestTime{10000};
};

/// 32 hexadecimal digits that nobody can guess, from the operating system. Throws Error if that has none.
[[nodiscard]] std::string randomToken();

/// Serves one page to browsers from memory, never from the disk: files by name, a stream of frames (a slow
/// viewer misses some), and events that pages send. Only those who know the token are served, and only
/// under an address of this machine, so that no other page in the same browser can reach it. The number of
/// connections, of those from one address (64), and of viewers, the sizes and times of requests, and of their
/// headers (16 KiB) are bounded. All methods may be called from any thread.
class LiveServer {
 public:
  static constexpr int kMostConnections = 256, kMostViewers = 32;
  static constexpr std::size_t kLongestMessage = 65536, kMostMessages = 256;

  /// Serves until it is destroyed. Throws Error if the address cannot be served, or the token is malformed.
  explicit LiveServer(const LiveServerOptions& options);
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  [[nodiscard]] int port() const;
  /// Where the page is, with the token.
  [[nodiscard]] std::string url() const;
  /// From now on serves this file under URL/NAME; the empty name is the page itself.
  void offer(const std::string& name, LiveFile file);
  /// No longer serves it.
  void withdraw(const std::string& name);
  /// Sends a frame, one line, to all viewers. Those who come later get the last one.
  void publish(const std::string& frame);
  /// The messages that have arrived, oldest first; waits for the first one, at most this long.
  [[nodiscard]] std::vector<std::string> takeMessages(std::chrono::microseconds atMost);
  /// The number of pages that now receive frames.
  [[nodiscard]] int viewers() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rex

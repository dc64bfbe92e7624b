#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <thread>

#include <sys/types.h>

namespace rex {

/// The connections of a server by the threads that serve them, to end those that take too long: who sends a
/// byte now and then, or takes one, would hold one of few. httplib bounds only the time between two bytes.
class Connections {
 public:
  /// `requestTime`: from the beginning of a connection, or the last answer, to the end of a request. An
  /// answer may take twelve times as long; streams take any time.
  explicit Connections(std::chrono::milliseconds requestTime) : requestTime_(requestTime) {}

  /// Finds the connection to `port` that was accepted last. Returns a descriptor of its own for it, or -1. No
  /// program that we start inherits either.
  int accepted(int port);

  /// The calling thread serves that descriptor from now on, and closes it at the end.
  void begin(int descriptor);
  void beginAnswer(bool isStream);
  void endAnswer();
  void end();

  /// Shuts down those whose time is over; their threads then end by themselves.
  void endSlow();

 private:
  using Clock = std::chrono::steady_clock;
  struct Served {
    int descriptor = -1;
    Clock::time_point until{};
  };
  void allow(Clock::time_point until);

  std::chrono::milliseconds requestTime_;
  std::mutex mutex_{};
  std::map<std::thread::id, Served> served_{};
  std::map<ino_t, int> known_{};  // inodes of sockets, with the descriptors
};

}  // namespace rex

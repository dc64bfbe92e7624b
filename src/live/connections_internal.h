#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include <sys/types.h>

namespace rex {

/// The connections of a server by the threads that serve them, to bound what strangers take before a handler
/// sees their request: those that take too long, as who sends a byte now and then would hold one of few;
/// headers without an end; many connections from one address. httplib bounds only the time between two bytes.
class Connections {
 public:
  static constexpr int kMostOfAnAddress = 64;
  static constexpr std::size_t kLongestHeader = 16384;

  /// `requestTime`: from the beginning of a connection, or the last answer, to the end of a request. An
  /// answer may take twelve times as long; streams take any time.
  explicit Connections(std::chrono::milliseconds requestTime) : requestTime_(requestTime) {}

  /// Finds the connection to `port` that was accepted last. Returns a descriptor of its own for it, or -1. No
  /// program that we start inherits either. Shuts it down if its address has as many as it may have.
  int accepted(int port);

  /// The calling thread serves that descriptor from now on, and closes it at the end.
  void begin(int descriptor);
  /// Waits until the header of the next request is there, which the parser then takes. Shuts the connection
  /// down if it is too long, or nothing more comes for two seconds.
  void awaitHeader();
  void beginAnswer(bool isStream);
  void end();

  /// Shuts down those whose time is over; their threads then end by themselves.
  void endSlow();

 private:
  using Clock = std::chrono::steady_clock;
  struct Served {
    int descriptor = -1;
    Clock::time_point until{};
  };
  struct Known {
    int descriptor = -1;
    std::string address{};
  };
  int allow(Clock::time_point until);

  std::chrono::milliseconds requestTime_;
  std::mutex mutex_{};
  std::map<std::thread::id, Served> served_{};
  std::map<ino_t, Known> known_{};  // inodes of sockets
};

}  // namespace rex

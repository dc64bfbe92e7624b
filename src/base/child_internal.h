#pragma once

namespace rex {

/// Takes the requests to stop that somebody holds back, for one who waits; without one, nothing ever arrives.
class StopRequests {
 public:
  StopRequests();
  ~StopRequests();
  StopRequests(const StopRequests&) = delete;
  StopRequests& operator=(const StopRequests&) = delete;

  /// To poll for one; -1, which polls as silent, where the system has no descriptors left.
  [[nodiscard]] int fd() const { return fd_; }
  /// The signal that arrived, or 0.
  [[nodiscard]] int take() const;

 private:
  int fd_ = -1;
};

}  // namespace rex

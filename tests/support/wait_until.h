#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace rex {

/// Asks every 20 ms whether something holds, for two minutes at most. Returns whether it does.
[[nodiscard]] inline bool waitUntil(const std::function<bool()>& holds) {
  for (int k = 0; k < 6000; ++k, std::this_thread::sleep_for(std::chrono::milliseconds(20)))
    if (holds()) return true;
  return false;
}

}  // namespace rex

#pragma once

namespace rex {

/// A machine short of memory kills programs that did nothing wrong. The same attempt once more where the
/// first one was killed: what kills itself does it again.
template <typename Attempt, typename Killed>
auto onceMoreIfKilled(const Attempt& attempt, const Killed& wasKilled) {
  auto first = attempt();
  return wasKilled(first) ? attempt() : first;
}

}  // namespace rex

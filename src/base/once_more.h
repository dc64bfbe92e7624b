#pragma once

namespace rex {

/// Repeats an attempt once if it was killed. A machine short of memory kills programs that did nothing
/// wrong, while a program that gets itself killed does so again.
template <typename Attempt, typename Killed>
auto onceMoreIfKilled(const Attempt& attempt, const Killed& wasKilled) {
  auto first = attempt();
  return wasKilled(first) ? attempt() : first;
}

}  // namespace rex

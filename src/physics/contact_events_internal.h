#pragma once

#include <utility>
#include <vector>

#include "physics/physics_world.h"

namespace rex::internal {

/// Follows which shapes touch, and notes what begins and ends.
class ContactEvents {
 public:
  /// Forgets what touched.
  void reset();
  /// Forgets the events, before a step.
  void clear() { events_.clear(); }
  /// What touches in the next inner step, in any order and as often as it likes, is put into touching() by
  /// the caller; update() then compares it with the last one.
  std::vector<std::pair<int, int>>& touching() { return now_; }
  void update(double time);
  [[nodiscard]] const std::vector<ContactEvent>& events() const { return events_; }

 private:
  void add(ContactEvent::Kind kind, const std::vector<std::pair<int, int>>& from,
           const std::vector<std::pair<int, int>>& except, double time);

  std::vector<std::pair<int, int>> now_, before_;
  std::vector<ContactEvent> events_;
};

}  // namespace rex::internal

#include <algorithm>

#include "physics/contact_events_internal.h"

namespace rex::internal {

void ContactEvents::reset() {
  before_.clear();
  events_.clear();
}

void ContactEvents::update(double time) {
  std::sort(now_.begin(), now_.end());
  now_.erase(std::unique(now_.begin(), now_.end()), now_.end());
  add(ContactEvent::Kind::kEnd, before_, now_, time);
  add(ContactEvent::Kind::kBegin, now_, before_, time);
  std::swap(now_, before_);
}

void ContactEvents::add(ContactEvent::Kind kind, const std::vector<std::pair<int, int>>& from,
                        const std::vector<std::pair<int, int>>& except, double time) {
  for (const auto& pair : from) {
    if (!std::binary_search(except.begin(), except.end(), pair))
      events_.push_back({kind, pair.first, pair.second, time});
  }
}

}  // namespace rex::internal

#pragma once

#include <optional>

namespace rex::sandbox {

/// The id of a user who owns nothing on this machine, reserved for one program at a time, also across
/// processes. Only root can reserve one.
class UserSlot {
 public:
  /// Reserves the first free id; none unless called by root. Throws Error if all are taken.
  UserSlot();
  ~UserSlot();
  UserSlot(const UserSlot&) = delete;
  UserSlot& operator=(const UserSlot&) = delete;

  [[nodiscard]] std::optional<unsigned> user() const { return user_; }

 private:
  std::optional<unsigned> user_{};
  int lock_ = -1;
};

}  // namespace rex::sandbox

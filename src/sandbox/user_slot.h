#pragma once

#include <optional>

namespace rex::sandbox {

/// A number of a user who owns nothing on this machine, for one program at a time: two slots never share it,
/// also not between processes. Only root can lend one.
class UserSlot {
 public:
  /// Takes the first that is free; none for others than root. Throws Error when all are taken.
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

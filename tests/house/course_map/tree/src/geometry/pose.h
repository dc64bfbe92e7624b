#pragma once

namespace rex {

class Frame;

/// Not compose(): that is only a word here.
struct Pose {
  double x = 0;
  [[nodiscard]] Pose inverse() const { return reversed(*this); }

 private:
  [[nodiscard]] Pose hidden() const;
};

[[nodiscard]] Pose translation(const Frame& from, double x = scaled(1));

}  // namespace rex

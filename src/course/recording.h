#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace rex {

/// The postures a simulator went through, evenly thinned so that a long run costs no more than a short one:
/// it keeps every stride-th posture, and doubles the stride when more than 2 * kCapacity are kept. The last
/// one is always there.
class Recording {
 public:
  static constexpr std::size_t kCapacity = 2048;

  void add(const Eigen::VectorXd& q);
  void clear();
  bool empty() const { return count_ == 0; }
  /// How many postures were added, kept or not.
  std::size_t count() const { return count_; }
  /// At most `most` of them, evenly spaced, first and last included. Throws Error unless most >= 2.
  [[nodiscard]] std::vector<Eigen::VectorXd> evenly(std::size_t most) const;

 private:
  std::vector<Eigen::VectorXd> kept_;
  Eigen::VectorXd last_;
  std::size_t stride_ = 1, count_ = 0;
};

}  // namespace rex

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace rex {

/// A posture that a simulator went through, and its time in seconds.
struct RecordedPosture {
  double time = 0;
  Eigen::VectorXd q{};
};

/// The postures that a simulator went through, thinned evenly so that a long run takes no more memory than
/// a short one: it keeps every stride-th posture, and doubles the stride when more than 2 * kCapacity are
/// kept. The last posture is always kept.
class Recording {
 public:
  static constexpr std::size_t kCapacity = 2048;
  static constexpr double kRate = 30;  ///< postures per second if none of them has a time

  /// Clears the recording and sets a provisional start, such as the posture of the scene file.
  void startAt(const Eigen::VectorXd& q);
  /// Adds a posture that was set, `seconds` after the previous one if that is known. The first one replaces
  /// the start, so that no motion begins with a jump from it.
  void add(const Eigen::VectorXd& q, std::optional<double> seconds = {});
  /// Adds a posture that the robot reached from the previous one, which may be the start, in that time.
  void step(const Eigen::VectorXd& q, double seconds);
  void clear();
  bool empty() const { return count_ == 0; }
  /// The number of postures added, whether kept or not.
  std::size_t count() const { return count_; }
  /// Whether any posture came with its time. If so, the others take no time; if not, postures are 1 / kRate
  /// apart.
  bool isTimed() const { return isTimed_; }
  /// Seconds from the first posture to the last.
  [[nodiscard]] double duration() const;
  /// At most `most` postures, evenly spaced in time and including the first and last, with times that start
  /// at 0. If several have the same time, the last one counts. Untimed postures are 1 / kRate apart even
  /// after thinning. Throws Error unless most >= 2.
  [[nodiscard]] std::vector<RecordedPosture> evenly(std::size_t most) const;

 private:
  void append(const Eigen::VectorXd& q, double seconds);
  [[nodiscard]] std::vector<RecordedPosture> kept() const;

  std::vector<RecordedPosture> kept_;
  RecordedPosture last_;
  std::size_t stride_ = 1, count_ = 0;
  bool isTimed_ = false, isStart_ = false;
};

}  // namespace rex

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace rex {

/// A posture that a simulator went through, and when, seconds.
struct RecordedPosture {
  double time = 0;
  Eigen::VectorXd q{};
};

/// The postures a simulator went through, evenly thinned so that a long run costs no more than a short one:
/// it keeps every stride-th posture, and doubles the stride when more than 2 * kCapacity are kept. The last
/// one is always there.
class Recording {
 public:
  static constexpr std::size_t kCapacity = 2048;
  static constexpr double kRate = 30;  ///< postures per second where nobody says how long they take

  /// Where a motion may start: the posture of the file, say.
  void startAt(const Eigen::VectorXd& q);
  /// A posture that was set, `seconds` after the one before if that is known. The first takes the place of
  /// the start, so that no motion begins with a jump from it.
  void add(const Eigen::VectorXd& q, std::optional<double> seconds = {});
  /// A posture to which the robot moved from the one before, the start included, in that time.
  void step(const Eigen::VectorXd& q, double seconds);
  void clear();
  bool empty() const { return count_ == 0; }
  /// How many postures were added, kept or not.
  std::size_t count() const { return count_; }
  /// Whether any posture came with its time. Those that did not took none then; where none did, postures are
  /// 1 / kRate apart.
  bool isTimed() const { return isTimed_; }
  /// Seconds from the first posture to the last.
  [[nodiscard]] double duration() const;
  /// At most `most` of them, evenly spaced in time, first and last included, their times from 0 on. Of
  /// postures at the same time the last counts. Where untimed ones are thinned, those that are left are
  /// 1 / kRate apart. Throws Error unless most >= 2.
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

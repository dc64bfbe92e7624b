#pragma once

#include <optional>

#include "collision/contacts.h"

namespace rex {

/// Bounds of the smallest distance of all pairs during a motion, metres: `atLeast` is proven, `atMost` was
/// measured at some point. Infinite without pairs.
struct ClearanceBounds {
  double atLeast = 0, atMost = 0;
};

/// Bounds, at most `tolerance` apart, of the smallest distance of all pairs while q moves straight from
/// `from` to `to`, metres; negative in overlap. It bisects intervals of the motion in which a pair could
/// come nearer than at the ends, given how fast the joints can move any point (conservative advancement). A
/// pair at constant distance takes time proportional to 1/tolerance; after 500 000 distances it returns the
/// bounds proven so far, which may be farther apart. Throws Error for vectors that are not nq long or not
/// finite, a tolerance below 1e-9, and a quaternion that is zero on the way.
[[nodiscard]] ClearanceBounds clearanceBounds(const Model& model, const ContactModel& contacts,
                                              const VectorArg& from, const VectorArg& to, double tolerance);

/// The lower of these bounds. Throws as clearanceBounds().
[[nodiscard]] double motionClearance(const Model& model, const ContactModel& contacts, const VectorArg& from,
                                     const VectorArg& to, double tolerance);

/// Follows a motion and proves that nothing comes near, mostly without measuring: once the distances of all
/// pairs are known, they shrink no faster than the joints between their shapes can move them. It holds a
/// workspace, so threads must not share one.
class ClearanceWatch {
 public:
  /// Pairs whose shapes no joint can move are left out. It must get the same model in each call.
  explicit ClearanceWatch(const Model& model);

  /// Whether it can prove anything: all joints that move are hinges.
  [[nodiscard]] bool isAble() const { return isAble_; }
  /// Whether all pairs are proven to stay more than `distance` metres apart while each entry of q moves by up
  /// to `reserve * |v|` from here. False if this is not known: after some failures it measures only at each
  /// eighth call.
  [[nodiscard]] bool isApart(const Model& model, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                             double reserve, double distance);
  /// Forgets what was measured, so that the answers are those of a new one.
  void reset();

 private:
  [[nodiscard]] Eigen::VectorXd motionLevers(const Model& model, const ShapePair& pair) const;
  void measure(const Model& model, const Eigen::VectorXd& q);
  [[nodiscard]] bool isProven(const Eigen::VectorXd& way, double distance);

  std::optional<ContactModel> contacts_{};  // if it can prove anything
  bool isAble_ = true;
  std::vector<std::size_t> pairs_;  // of contacts_
  Eigen::MatrixXd levers_;          // of each pair, metres per entry of q: how far it can move their points
  Eigen::VectorXd distances_, left_, at_, way_;
  bool isMeasured_ = false;
  int wait_ = 0;
  BodyPoses poses_;
  ProxyStorage storage_;
};

}  // namespace rex

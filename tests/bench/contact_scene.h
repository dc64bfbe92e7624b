#pragma once

#include <functional>

#include "collision/contacts.h"
#include "kinematics/forward_kinematics.h"

namespace rex::bench {

/// The arm of data/robots/pegInAHole.ors before its frame of four boxes, at random postures. Pairs: each of
/// its seven capsules with each box, and with each capsule that is not next to it; 43 in all.
struct ContactScene {
  static constexpr int kPostures = 256;
  ContactScene();

  Model model;
  ContactModel contacts;
  Eigen::MatrixXd Q;  ///< kPostures, in columns
  std::vector<BodyPoses> poses;
  PoseBatch batch;
  Eigen::MatrixXd distances;  ///< of all pairs, in columns

  [[nodiscard]] const ModelShape& shape(int i) const { return model.shapes()[static_cast<std::size_t>(i)]; }
  /// X_WS of a shape at posture k.
  [[nodiscard]] Pose shapePose(int i, int k) const {
    return poses[static_cast<std::size_t>(k)][shape(i).body] * shape(i).X_BS;
  }
};

/// Whether there is contact at posture k of the scene, as FCL says; throws std::logic_error where it and we
/// disagree by more than its own tolerance. Empty: not installed.
using ContactPeer = std::function<bool(int k)>;
#ifdef REX_WITH_FCL
[[nodiscard]] ContactPeer fclPeer(const ContactScene& scene);
/// Whether there is contact where the bodies are there.
[[nodiscard]] std::function<bool(const BodyPoses&)> fclContact(const ContactScene& scene);
#else
[[nodiscard]] inline ContactPeer fclPeer(const ContactScene&) { return {}; }
#endif

/// Throws std::logic_error where the peer finds contact though all pairs are `tolerance` apart, or finds none
/// though two overlap by that.
void requireAgreement(const std::string& name, const ContactScene& scene, const ContactPeer& peer,
                      double tolerance);

}  // namespace rex::bench

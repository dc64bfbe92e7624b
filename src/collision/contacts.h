#pragma once

#include "collision/contact_model.h"
#include "collision/proximity.h"
#include "kinematics/task_map.h"

namespace rex {

/// A pair of shapes that are close to each other.
struct Proxy {
  ShapePair pair;
  Proximity proximity;
};

/// Default margin and cutoff of queries, metres.
inline constexpr double kContactMargin = 0.1, kQueryCutoff = 0.5;

/// All pairs nearer than `cutoff` metres, in the order of contacts.pairs().
[[nodiscard]] std::vector<Proxy> proxies(const ContactModel& contacts, const BodyPoses& poses,
                                         double cutoff = kQueryCutoff);

/// The result of a query, and its workspace.
struct ProxyStorage {
  std::vector<Proxy> near;         ///< the result
  std::vector<Pose> X_WS;          ///< of the shapes in pairs
  std::vector<Proximity> pairs{};  ///< of contacts.pairs(), infinitely far if not computed
};
/// The same for hot loops; allocates nothing once `storage` has been used with these contacts and held as
/// many proxies.
void proxies(const ContactModel& contacts, const BodyPoses& poses, double cutoff, ProxyStorage& storage);

/// Jacobian of the distance of a pair: 1 x nv, metres per unit of v. One-sided where the nearest points jump.
[[nodiscard]] Eigen::RowVectorXd distanceJacobian(const Model& model, const BodyPoses& poses,
                                                  const Proxy& proxy, const ContactModel& contacts);

/// Cost of being nearer than the margin m > 0, metres: the sum over all pairs of [1 - d/m]^+ (slide 2:60 with
/// erratum 4), with negative d in overlap. It is exactly 0 if all pairs are m apart. Throws
/// Error unless the margin is positive.
[[nodiscard]] double contactCost(const ContactModel& contacts, const BodyPoses& poses,
                                 double margin = kContactMargin);

/// The same as a task map of one dimension, with its Jacobian. It holds a workspace, so threads must not
/// share one; give each a copy. Throws as contactCost().
[[nodiscard]] TaskMap contactTask(ContactModel contacts, double margin = kContactMargin);

}  // namespace rex

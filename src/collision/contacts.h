#pragma once

#include <memory>
#include <span>
#include <vector>

#include "collision/proximity.h"
#include "kinematics/forward_kinematics.h"
#include "kinematics/task_maps.h"
#include "scene/model.h"

namespace rex {

/// Two shapes, as indices of Model::shapes(), a < b.
struct ShapePair {
  int a, b;
  bool operator==(const ShapePair&) const = default;
};

/// The pairs of shapes of a model that may collide, sorted for fast queries. It copies the data it needs;
/// copies of it share them.
class ContactModel {
 public:
  /// The pairs of shapes that may collide, see collidingPairs(). Markers never collide. Throws Error for a
  /// shape whose mesh is not loaded.
  explicit ContactModel(const Model& model);
  /// The given pairs. Throws Error for an invalid pair of indices, a marker, and a mesh that is not loaded.
  ContactModel(const Model& model, std::span<const ShapePair> pairs);

  [[nodiscard]] std::span<const ShapePair> pairs() const;
  /// The body of a shape that occurs in a pair.
  [[nodiscard]] BodyId body(int shape) const;

  struct Data;
  [[nodiscard]] const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

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

/// Distances of all pairs in many configurations, metres, as proximity() gives them, negative in overlap.
/// Column k of `distances` belongs to configuration k, the rows to contacts.pairs(). Resizes `distances`.
void contactDistancesBatch(const ContactModel& contacts, const PoseBatch& poses, Eigen::MatrixXd& distances);

/// Whether each configuration keeps all pairs at least `margin` metres apart, in agreement with
/// contactDistancesBatch(), except that touching cylinders and meshes are not free at margin 0. Distances
/// that are not a number are not free. Resizes `free`.
void contactFreeBatch(const ContactModel& contacts, const PoseBatch& poses, double margin,
                      Eigen::Array<bool, Eigen::Dynamic, 1>& free);

/// Whether all configurations are free. Stops at the first that is not.
[[nodiscard]] bool allContactFree(const ContactModel& contacts, const PoseBatch& poses, double margin);
/// Overload for hot loops. Pairs that were the first to be found too near are asked first the next time:
/// `order` remembers them between calls with the same contacts, and starts empty.
[[nodiscard]] bool allContactFree(const ContactModel& contacts, const PoseBatch& poses, double margin,
                                  std::vector<int>& order);

}  // namespace rex

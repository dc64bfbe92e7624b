#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <BulletCollision/CollisionShapes/btEmptyShape.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include "physics/armature_internal.h"
#include "physics/contact_free_motion_internal.h"
#include "physics/coupling_internal.h"
#include "physics/simulated_tree_internal.h"

namespace rex::internal {

/// Constraints on one velocity of a joint or of a base that is free, all solved along with the contacts:
/// motor, limits, friction, damping.
class JointRow : public btMultiBodyConstraint {
 public:
  /// Of the freedom `place` of a link; both count from 0.
  JointRow(btMultiBody& body, int link, int place);
  /// Of a base; measureBase() says which velocity.
  explicit JointRow(btMultiBody& body);

  /// The velocity is angular * omega + linear * v, of the origin of the base; all in W.
  void measureBase(const btVector3& angular, const btVector3& linear);

  void setGoals(const JointGoals& goals) { goals_ = goals; }
  /// Forgets the goals and the impulses of the last step, from which the solver starts otherwise.
  void forget();

  void finalizeMultiDof() override;
  int getIslandIdA() const override;
  int getIslandIdB() const override { return getIslandIdA(); }
  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override;
  void debugDraw(btIDebugDraw*) override {}

 private:
  int place_ = 0;
  JointGoals goals_;
};

/// A tree of bodies on joints as one of Bullet's multibodies. Joints of several coordinates become chains of
/// links without mass, of one coordinate or one quaternion each. Links that follow others, which are of
/// joints that mimic or are the rise of a screw, have coordinates of their own here; Couplings keep them.
class Articulation : public SimulatedTree {
 public:
  /// `bodies` hang on one joint of what stands still at X_WP, parents first. `shapes` are in the frames of
  /// the links and must outlive it; null: none.
  Articulation(const Model& model, std::span<const BodyId> bodies, const Pose& X_WP,
               std::span<btCollisionShape* const> shapes, const PhysicsOptions& options);

  void addTo(btMultiBodyDynamicsWorld& world) override;
  void removeFrom(btMultiBodyDynamicsWorld& world) override;
  void place(const State& state) override;
  void read(State& state) const override;
  void drive(std::span<const Motor> motors, double h) override;
  void remember() override;
  void undo() override;
  [[nodiscard]] int runaway(double limit) const override;

  /// Calls visit(qIndex, place, follower) for each hinge and slider; `follower` is null for those that lead,
  /// and else lacks its leader.
  template <class Visit>
  void forEachCoordinate(const Visit& visit) {
    for (const Coordinate& one : coordinates_) {
      if (one.isBall) continue;
      const CoordinatePlace at{&*body_, one.link};
      const Follower follower{
          .at = at, .leader = {}, .ratio = one.ratio, .offset = one.offset, .joint = one.joint};
      visit(one.qIndex, at, one.follows ? &follower : nullptr);
    }
  }

  [[nodiscard]] btMultiBody& body() { return *body_; }
  /// The link that is a body, -1 for the base; empty if the body is not of this tree.
  [[nodiscard]] std::optional<int> linkOf(BodyId body) const {
    const auto found = links_.find(body);
    return found == links_.end() ? std::nullopt : std::optional(found->second);
  }

  /// Calls visit(object, body) for what collides of each body.
  template <class Visit>
  void forEachObject(const Visit& visit) {
    for (const auto& collider : colliders_) visit(*collider.object, collider.body);
  }

 private:
  // A link that moves: its coordinates, and how they are turned. Bullet's spherical joints count in the frame
  // of the link.
  struct Coordinate {
    int link = 0, qIndex = 0, vIndex = 0;
    bool isBall = false;
    Eigen::Matrix3d R_ML = Eigen::Matrix3d::Identity();  // of balls
    bool follows = false;  // its coordinate is ratio * q[qIndex] + offset, and no motor acts on it directly
    double ratio = 1, offset = 0;
    JointId joint = kNoJoint;
    JointLaw law{};
    int armatureRow = -1;                                  // the first one, if it has an armature or a spring
    double rest = 0;                                       // of the spring
    Eigen::Matrix3d R_rest = Eigen::Matrix3d::Identity();  // of balls
  };
  struct Collider {
    std::unique_ptr<btMultiBodyLinkCollider> object;
    BodyId body;
  };
  // Where the links of a tree have got to while it is built.
  struct Grown {
    int link;
    Pose X_BL;
  };

  Grown grow(const Model& model, JointId id, const BulletLink& link, Grown parent);
  void addCoordinate(const Model& model, JointId id, const JointMovement& move, const Eigen::Matrix3d& R_ML);
  void addCollider(int link, BodyId body, btCollisionShape* shape);
  [[nodiscard]] bool hasBaseRows() const;
  void addLift(const Body& body, int link);
  void addRows();
  void addArmature();
  void pull(const Coordinate& one, int place, const Motor& motor, double h, JointRow& row);
  [[nodiscard]] JointGoals withoutSpring(const JointLaw& law, JointGoals goals, int armatureRow);
  [[nodiscard]] double stretchOf(const Coordinate& one, int place) const;
  void driveBase(std::span<const Motor> motors, double h);
  [[nodiscard]] FreeMotion::LinkMotion baseMotion() const;
  void setBase(const FreeMotion::LinkMotion& motion);
  void update();

  PhysicsOptions options_;
  btEmptyShape nothing_;
  std::optional<FreeMotion> base_;  // of trees on a free joint
  Joint baseJoint_{};
  JointLaw baseLaw_{};
  State baseState_{};  // of the whole model; if the base has a spring
  int next_ = 0;       // link to be built
  std::optional<btMultiBody> body_;
  std::map<BodyId, int> links_;
  std::vector<Coordinate> coordinates_;
  std::vector<Collider> colliders_;
  // Six for a base that has a law, linear before angular; then one per coordinate, three per ball.
  std::vector<std::unique_ptr<JointRow>> rows_;
  std::vector<std::pair<int, btVector3>> lifts_;  // forces at the centres of links, by their buoyancy
  std::optional<Armature> armature_;              // if some joint has one; a base that does comes first
  btAlignedObjectArray<btQuaternion> rotations_;
  btAlignedObjectArray<btVector3> origins_;
  btTransform rememberedBase_;
  std::vector<double> remembered_;
};

}  // namespace rex::internal

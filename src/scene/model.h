#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "base/require.h"
#include "geometry/pose.h"
#include "geometry/shape.h"
#include "scene/link.h"
#include "scene/scene_spec.h"

namespace rex {

/// Handles into a Model: indices of bodies() and joints(). kWorld is body 0.
enum class BodyId : int {};
enum class JointId : int {};
inline constexpr BodyId kWorld{0};
inline constexpr JointId kNoJoint{-1};

/// A rigid body. Bodies without a joint are fixed to the world at the pose X_PB.
struct Body {
  std::string name;
  BodyId parent = kWorld;
  JointId joint = kNoJoint;         ///< the joint that moves it
  Pose X_PB{};                      ///< pose in the parent; only for bodies without a joint
  double mass = 0;                  ///< kg
  Eigen::Vector3d p_BBcm{0, 0, 0};  ///< centre of mass, in B
  Eigen::Matrix3d I_BBcm_B = Eigen::Matrix3d::Zero();  ///< inertia about the centre of mass, in B, kg m^2
  double subtreeMass = 0;                              ///< kg, with all its descendants
  double buoyancy = 0;                                 ///< see BodySpec
  BodyKind kind = BodyKind::kDynamic;
};

/// One degree of freedom as a twist: the angular velocity of the joint, and the velocity of the point at
/// the origin, per unit of v. It is constant in its frame: that of the parent or of the child body.
struct DegreeOfFreedom {
  enum class Frame { kParent, kChild };
  Eigen::Vector3d angular{0, 0, 0};
  Eigen::Vector3d linear{0, 0, 0};
  Frame frame = Frame::kParent;
};

/// A joint: X_PC = X_PF * X_FM(q) * X_MC. Mimic joints share the q and v indices of their target; their own
/// coordinate is ratio * q + offset, and their freedoms already include the ratio.
struct Joint {
  std::string name;
  JointType type = JointType::kRigid;
  BodyId parent{}, child{};
  Pose X_PF, X_MC;
  Eigen::Vector3d axis{1, 0, 0};  ///< unit vector, if its type has one
  double pitch = 0;               ///< pitch of a screw, metres per turn
  int qIndex = 0, vIndex = 0;
  int nq = 0, nv = 0;
  bool mimics = false;  ///< never a rigid joint
  double ratio = 1, offset = 0;
  double maxVelocity = std::numeric_limits<double>::infinity();  ///< see JointSpec
  double maxEffort = std::numeric_limits<double>::infinity();
  double damping = 0, friction = 0;
  double armature = 0, stiffness = 0;
  Eigen::VectorXd springReference{};          ///< nq, of its own coordinate; a unit quaternion
  std::array<DegreeOfFreedom, 6> freedoms{};  ///< the first nv are used
};

/// The movements of a joint of a model, see joint_type.h.
[[nodiscard]] inline JointMovements movements(const Joint& joint) {
  return movements(joint.type, joint.axis, joint.pitch);
}

/// A shape and its pose X_BS on its body.
struct ModelShape {
  std::string name;
  BodyId body = kWorld;
  Pose X_BS;
  Shape shape;
  Eigen::Vector4d color{1, 1, 1, 1};
  bool contact = false;
  bool visible = true;
  ContactMask mask{};
  bool ground = false;  ///< see ShapeSpec
};

/// Whether a pair of bodies may collide, or, without a `b`, all pairs of `a`; see CollisionChoice.
struct PairChoice {
  BodyId a = kWorld;
  std::optional<BodyId> b{};
  bool mayCollide = false;
  std::string reason{};
};

/// A ball joint that closes a loop: point P of body a stays at point Q of body b; see PinSpec. The tree of
/// joints does not know of it: PhysicsWorld keeps it, and pinTasks() of kinematics/closed_loops.h.
struct Pin {
  BodyId a = kWorld, b = kWorld;
  Eigen::Vector3d p_AP, p_BQ;  ///< metres
};

/// A posture that the file names; see PostureSpec.
struct NamedPosture {
  std::string name;
  Eigen::VectorXd q;  ///< nq
};

/// An immutable robot world; only compile() makes one. Bodies and joints are sorted breadth-first from the
/// roots (roots in file order, then each body's joints in file order), which is also the order of q. The
/// world is body 0.
class Model {
 public:
  int nq() const { return static_cast<int>(q0_.size()); }
  int nv() const { return nv_; }
  const std::string& name() const { return name_; }
  const std::vector<Body>& bodies() const { return bodies_; }
  const std::vector<Joint>& joints() const { return joints_; }
  const std::vector<ModelShape>& shapes() const { return shapes_; }
  const Body& operator[](BodyId id) const { return bodies_[static_cast<std::size_t>(id)]; }
  const Joint& operator[](JointId id) const { return joints_[static_cast<std::size_t>(id)]; }

  /// The steps that place all bodies but the world, in order: joints and fixed bodies, for kernels.
  const std::vector<MotionStep>& motionSteps() const { return motionSteps_; }

  /// The moving parts, for kernels of dynamics; what is fixed to the world belongs to none.
  const std::vector<Link>& links() const { return links_; }

  /// Which bodies may collide: the rule, and choices by name. Applied in collision/collision_pairs.h.
  CollisionRule collisionRule() const { return collisionRule_; }
  const std::vector<PairChoice>& collisionChoices() const { return collisionChoices_; }

  /// What closes loops, in the order of the scene file.
  const std::vector<Pin>& pins() const { return pins_; }

  /// All bodies but the world, in the order of the scene file.
  const std::vector<BodyId>& bodiesInFileOrder() const { return fileOrder_; }

  /// The first body of that name (in file order), or the body of the first shape of that name, as the
  /// course's exercises expect. Throws Error naming the scene and the closest names.
  BodyId body(std::string_view name) const;

  /// The posture described by the file, nq.
  const Eigen::VectorXd& initialPositions() const { return q0_; }
  /// Others that the file names, in its order.
  const std::vector<NamedPosture>& postures() const { return postures_; }
  /// The one of that name, such as "key:home". Throws Error with the names that there are.
  const Eigen::VectorXd& posture(std::string_view name) const;
  /// Limits of each coordinate, nq; infinite where there are none. They include those of mimic joints:
  /// within them, each mimic joint's ratio * q + offset stays within its own limits.
  const Eigen::VectorXd& lowerLimits() const { return lower_; }
  const Eigen::VectorXd& upperLimits() const { return upper_; }
  /// Sum of all masses, kg.
  double mass() const { return mass_; }
  /// What the armature of joints adds to the diagonal of the mass matrix, nv; that of mimic joints times
  /// ratio^2.
  const Eigen::VectorXd& armature() const { return armature_; }
  /// Whether a joint has stiffness.
  bool hasSprings() const { return hasSprings_; }
  /// Whether a body with a mass has buoyancy.
  bool hasBuoyancy() const { return hasBuoyancy_; }

 private:
  friend Model compile(const SceneSpec& spec);
  Model() = default;

  std::string name_;
  std::vector<Body> bodies_;
  std::vector<Joint> joints_;
  std::vector<ModelShape> shapes_;
  std::vector<MotionStep> motionSteps_;
  std::vector<Link> links_;
  std::vector<BodyId> fileOrder_;
  CollisionRule collisionRule_ = CollisionRule::kAllButNeighbours;
  std::vector<PairChoice> collisionChoices_;
  std::vector<Pin> pins_;
  std::vector<NamedPosture> postures_;
  std::unordered_map<std::string, BodyId> bodyByName_;
  Eigen::VectorXd q0_, lower_, upper_, armature_;
  bool hasSprings_ = false, hasBuoyancy_ = false;
  int nv_ = 0;
  double mass_ = 0;
};

/// Checks a scene and freezes it. Throws Error, with the position in the file if known, for a joint to an
/// unknown body, two joints with one name, two joints that move one body, a loop, a mimic of an unknown
/// joint or one of another type, mimic limits that leave no allowed position, a collision choice or a pin
/// that does not name two bodies, a named posture of an unknown joint, and masses, sizes, poses or limits
/// that are not finite or have the wrong sign or count. An inertia with a negative principal moment is
/// refused, one that violates the triangle inequality is not.
[[nodiscard]] Model compile(const SceneSpec& spec);

}  // namespace rex

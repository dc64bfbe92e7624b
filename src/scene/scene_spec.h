#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "base/error.h"
#include "geometry/pose.h"
#include "geometry/shape.h"
#include "scene/joint_type.h"

namespace rex {

/// Which shapes in contact a shape may touch, by the rule of MuJoCo: bits of `type` that the other one has in
/// `affinity`, or the other way round. Whatever is not from an MJCF file has 1 and 1.
struct ContactMask {
  std::uint32_t type = 1, affinity = 1;
  /// Numbers of pairs that touch whatever the bits say: each number belongs to the shapes that have it.
  std::vector<int> pairs{};

  bool operator==(const ContactMask&) const = default;
};

/// Whether two masks have the number of a pair in common.
[[nodiscard]] inline bool arePaired(const ContactMask& a, const ContactMask& b) {
  return std::ranges::any_of(a.pairs, [&](int pair) { return std::ranges::count(b.pairs, pair) > 0; });
}

/// Whether shapes with these masks may touch.
[[nodiscard]] inline bool mayTouch(const ContactMask& a, const ContactMask& b) {
  return (a.type & b.affinity) != 0 || (b.type & a.affinity) != 0 || arePaired(a, b);
}

/// The name of the world frame as the parent of joints; no body may have it.
inline constexpr const char* kWorldName = "world";

/// Stands for no limit.
inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();

enum class BodyKind { kDynamic, kKinematic, kStatic };

/// A shape on a body (or in the world); X_BS is its pose in the body's frame.
struct ShapeSpec {
  std::string name;
  Pose X_BS;
  Shape shape;
  Eigen::Vector4d color{0.8, 0.8, 0.8, 1};  ///< red, green, blue, opacity, each 0..1
  bool contact = false;                     ///< takes part in collision detection
  bool visible = true;                      ///< is drawn
  std::string meshFile{};                   ///< what `shape.mesh` is read from, see loadMeshes()
  Eigen::Vector3d meshScale{1, 1, 1};
  std::filesystem::path meshPath{};  ///< the file that loadMeshes() found; empty before
  bool meshMissing = false;          ///< `shape` only stands in for the mesh; compile() gives it no contact
  SourceLocation where{};
  ContactMask mask{};   ///< which others it may touch
  bool ground = false;  ///< the ground of pictures lies where the highest point of such shapes is
  /// Whether the mesh has the axes of its Collada file, as in ROS, or those after its `meshTurn` to z up.
  bool ignoresUpAxis = false;
  Eigen::Matrix3d meshTurn = Eigen::Matrix3d::Identity();  ///< set by loadMeshes(); identity: it has z up
};

/// A rigid body. X_WB is used for roots only; the pose of a body moved by a joint follows from the joint.
struct BodySpec {
  std::string name;
  Pose X_WB;
  double mass = 0;                           ///< kg; 0: massless
  Eigen::Vector3d p_BBcm{0, 0, 0};           ///< centre of mass in B, metres
  std::optional<Eigen::Matrix3d> inertia{};  ///< about the centre of mass, in B, kg m^2; unset: 0.2 m Id
  /// The share of its weight that something else carries, at its centre of mass: 1 lets it float, more lifts
  /// it.
  double buoyancy = 0;
  BodyKind kind = BodyKind::kDynamic;
  std::vector<ShapeSpec> shapes{};
  SourceLocation where{};
};

/// A joint: X_W,child = X_W,parent * X_PF * X_FM(q) * X_MC. Parent and child name the first body of that
/// name; the parent may be "world". Damping and friction oppose the motion with damping * v + friction *
/// sign(v). A spring pulls with stiffness * (q - springReference), at quaternions by the turn from there.
struct JointSpec {
  std::string name;
  std::string parent, child;
  JointType type = JointType::kHinge;
  Pose X_PF, X_MC;
  Eigen::Vector3d axis{1, 0, 0};     ///< in F, any length but zero; if its type has one
  double pitch = 0;                  ///< pitch of a screw, metres per turn
  Eigen::VectorXd q0{};              ///< initial coordinates; empty: the zero position
  Eigen::VectorXd lower{}, upper{};  ///< its own limits of each coordinate; empty: none
  std::string mimic{};  ///< a joint that this one follows: q = ratio * q of that joint + offset; empty: none
  double mimicRatio = 1, mimicOffset = 0;  ///< other than 1 and 0 only for joints of one coordinate
  double maxVelocity = kUnlimited;         ///< rad/s or m/s
  double maxEffort = kUnlimited;           ///< N m or N
  double damping = 0;                      ///< N m s/rad or N s/m
  double friction = 0;                     ///< N m or N
  double armature = 0;                ///< of the motor, added to the inertia of each coordinate: kg m^2 or kg
  double stiffness = 0;               ///< of a spring: N m/rad or N/m
  Eigen::VectorXd springReference{};  ///< its coordinates where the spring rests; empty: the zero position
  SourceLocation where{};

  /// q0, or the zero position if that is empty.
  [[nodiscard]] Eigen::VectorXd start() const;
};

/// The pairs of bodies that may collide unless a CollisionChoice decides, see collision/collision_pairs.h:
/// all but neighbours and bodies that overlap at home and in the middle of all limits, or, as in scenes of
/// the course, all but kin within four generations.
enum class CollisionRule { kAllButNeighbours, kFourGenerations };

/// "all_but_neighbours", "four_generations".
[[nodiscard]] std::string_view toString(CollisionRule rule);

/// Says whether one pair of bodies may collide, or, with an empty `b`, all pairs of `a`. Each name stands
/// for the first body of that name, or for "world". A choice for one pair overrides one for all pairs of a
/// body, and "must not" overrides "may".
struct CollisionChoice {
  std::string a, b;
  bool mayCollide = false;
  std::string reason{};  ///< for people
  SourceLocation where{};
};

/// A ball joint that closes a loop of joints: point P of one body stays at point Q of another. Each name
/// stands for the first body of that name, or for "world". See kinematics/closed_loops.h.
struct PinSpec {
  std::string a, b;
  Eigen::Vector3d p_AP{0, 0, 0}, p_BQ{0, 0, 0};  ///< metres
  SourceLocation where{};
};

/// A posture that a file names. Joints that it does not list are as in the scene.
struct PostureSpec {
  std::string name;  ///< as users give it: "key:home" of an MJCF file, "state:ready" of an SRDF
  std::vector<std::pair<std::string, Eigen::VectorXd>> joints{};  ///< the coordinates of a joint by its name
  SourceLocation where{};
};

/// A scene as it is read and edited. Bodies keep file order; compile() turns it into a Model.
struct SceneSpec {
  std::string name;  ///< for messages: the file name
  std::vector<BodySpec> bodies;
  std::vector<JointSpec> joints;
  std::vector<ShapeSpec> worldShapes;
  CollisionRule collisionRule = CollisionRule::kAllButNeighbours;
  std::vector<CollisionChoice> collisionChoices{};
  std::vector<PinSpec> pins{};
  std::vector<PostureSpec> postures{};
};

}  // namespace rex

#include "gallery/robots.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "grasping/equilibrium.h"
#include "kinematics/inverse_kinematics.h"
#include "kinematics/jacobians.h"
#include "render/contact_sheet.h"
#include "render/picture.h"
#include "render/renderer.h"
#include "support/closing_hand.h"

namespace rex::gallery {
namespace {

using Eigen::Vector3d;
using Posture = std::vector<std::pair<std::string, double>>;

// How a scene is shown: its posture, by its name or the names of joints; which bodies reach for which others;
// from where.
struct Portrait {
  std::string file{};  // below data
  Posture posture{};
  std::string named{};  // such as "state:home"
  std::vector<std::pair<std::string, std::string>> reaching{};
  Vector3d direction = kDefaultView;
  double cell = 0.25;  // of the ground
};

Eigen::VectorXd postureOf(const Model& model, const Portrait& portrait) {
  Eigen::VectorXd q = portrait.named.empty() ? model.initialPositions() : model.posture(portrait.named);
  for (const auto& [name, value] : portrait.posture) {
    const auto joint = std::find_if(model.joints().begin(), model.joints().end(),
                                    [&name = name](const Joint& one) { return one.name == name; });
    if (joint == model.joints().end()) throw Error({.what = portrait.file + ": no joint " + name});
    q[joint->qIndex] = value;
  }
  const auto count = static_cast<Eigen::Index>(portrait.reaching.size());
  Eigen::MatrixXd J(3 * count, model.nv());
  Eigen::VectorXd miss(3 * count);
  for (int step = 0; count > 0 && step < 60; ++step) {
    const BodyPoses poses = forwardKinematics(model, q);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto& [hand, target] = portrait.reaching[static_cast<std::size_t>(i)];
      J.middleRows(3 * i, 3) = positionJacobian(model, poses, model.body(hand), Vector3d::Zero());
      miss.segment(3 * i, 3) = poses[model.body(target)].p - poses[model.body(hand)].p;
    }
    q += inverseKinematicsStep(J, miss, 0.1);
  }
  return q;
}

Image drawn(const Portrait& portrait, int width = kSlideWidth, int height = kSlideHeight) {
  const Model model = compile(readScene(sourcePath("data") / portrait.file).spec);
  Picture picture = scenePicture(model, forwardKinematics(model, postureOf(model, portrait)));
  picture.ground.cell = portrait.cell;
  // The light comes over the left shoulder of who looks.
  const Vector3d& d = portrait.direction;
  picture.toLight = {0.6 * d.x() + 0.7 * d.y(), 0.6 * d.y() - 0.7 * d.x(), 0.9 * d.norm()};
  return Renderer({.width = width, .height = height})
      .draw(picture, framing(bounds(picture), d, static_cast<double>(width) / height));
}

Image courseRobots() {
  std::vector<KeyFrame> frames;
  for (const char* name : {"arm3", "pegArm", "pegArm2", "pegInAHole", "arm7", "pin_balancing"}) {
    const std::string file = name + std::string(".ors");
    frames.push_back({drawn({.file = "robots/" + file, .cell = 0.5}, 260, 240), file});
  }
  return contactSheet(frames);
}

Image publishedRobots() {
  std::vector<KeyFrame> frames;
  for (const auto& [name, posture, cell] : {std::tuple{"arm6dof", "reach", 0.25},
                                            {"arm7offset", "home", 0.25},
                                            {"gripper", "home", 0.05},
                                            {"humanoid_hands", "squat", 0.25}}) {
    const std::string file = std::string("robots/") + name + "/" + name + ".urdf";
    frames.push_back({drawn({.file = file,
                             .named = std::string("state:") + posture,
                             .direction = {1.9, -1.2, 0.6},
                             .cell = cell},
                            300, 280),
                      name});
  }
  return contactSheet(frames, {.columns = 2});
}

Posture halfClosed() {
  Posture posture = {{"thumb_knuckle", 0.3}, {"thumb_opposition", 0.4}, {"thumb_middle_bend", 0.3}};
  double bend = 0.3;
  for (const std::string finger : {"index", "middle", "ring", "little"}) {
    posture.emplace_back(finger + "_knuckle", bend);
    posture.emplace_back(finger + "_middle_bend", 0.4);
    bend += 0.06;
  }
  return posture;
}

Posture waving() {
  return {{"right_shoulder_pitch", -1.2}, {"right_shoulder_roll", -0.5},
          {"right_elbow", -1.9},          {"left_shoulder_roll", 0.12},
          {"left_elbow", -0.5},           {"neck_yaw", -0.3},
          {"left_hip_pitch", -0.35},      {"left_knee", 0.4},
          {"left_ankle_pitch", -0.05}};
}

// The simulation closes the hand; the arrows are forces within the friction cones that carry the ball.
Image grasp() {
  constexpr double kLength = 0.04;  // metres of an arrow for 1 N
  const Shape ball = ballShape(0.03);
  const Model model = closing_hand::handAnd(ball);
  PhysicsWorld world = closing_hand::worldOf(model, initialState(model), Vector3d::Zero());
  world.step(3);
  const Pose X_WO = closing_hand::objectPose(model, world.state());
  const std::vector<Contact> contacts = closing_hand::contactsOf(model, world);
  const Eigen::VectorXd weight =
      weightWrench(closing_hand::kMass, {0, 0, 0}, X_WO.R.transpose() * Vector3d(0, 0, -9.81));
  const Equilibrium held = equilibrium(wrenchCones(contacts), weight);
  Picture picture = scenePicture(model, forwardKinematics(model, world.state().q));
  for (Solid& solid : picture.solids)
    if (solid.name == "object")
      solid.color = {0.2f, 0.5f, 0.9f, 0.75f};
    else
      solid.color = {0.85f, 0.86f, 0.88f, 0.35f};
  PointSet touched{.color = {0.8f, 0.1f, 0.12f}, .size = 16};
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Vector3d force_O = contactFrame(contacts[i]) * held.forces_C.col(static_cast<Eigen::Index>(i));
    const Vector3d at_W = X_WO * contacts[i].p_OC, force_W = X_WO.R * force_O;
    touched.points.push_back(at_W);
    if (force_W.norm() > 1e-3)
      picture.arrows.push_back(
          {.from = at_W - kLength * force_W, .to = at_W, .color = {1.0f, 0.75f, 0.0f}, .radius = 0.002});
  }
  picture.pointSets.push_back(std::move(touched));
  picture.ground.cell = 0.05;
  const Bounds shown{.low = X_WO.p.array() - 0.075, .high = X_WO.p.array() + 0.075};
  return Renderer({.width = kSlideWidth, .height = kSlideHeight})
      .draw(picture, framing(shown, {1.5, 1, 0.4}, 4. / 3));
}

}  // namespace

std::vector<Drawing> robotPictures() {
  const auto portrait = [](std::string name, std::string title, std::string text, Portrait one) {
    return Drawing{std::move(name), std::move(title), std::move(text), [one] { return drawn(one); }};
  };
  return {
      {"course-robots", "The arms of the course",
       "In `data/robots/*.ors`, links are capsules and joints are hinges.", courseRobots},
      portrait("arm7dof", "An arm with seven joints",
               "The joints of `data/robots/arm7dof/arm7dof.urdf` rotate alternately about z and y.",
               {.file = "robots/arm7dof/arm7dof.urdf",
                .posture = {{"shoulder_yaw", -0.6},
                            {"shoulder_pitch", 0.5},
                            {"elbow_pitch", 1.2},
                            {"wrist_pitch", 0.9}},
                .direction = {1.5, -2, 0.7}}),
      {"own-robots", "Two arms, a gripper and a humanoid with hands",
       "In `data/robots/*/*.urdf`, the arms and the gripper have the lengths and limits of published "
       "robots.",
       publishedRobots},
      portrait("balancer", "A robot on two wheels",
               "`data/robots/balancer/balancer.urdf` falls without control.",
               {.file = "robots/balancer/balancer.urdf", .direction = {1.5, -1.2, 0.6}}),
      portrait(
          "quadruped", "A quadruped", "`data/robots/quadruped/quadruped.urdf` has three hinges in each leg.",
          {.file = "robots/quadruped/quadruped.urdf", .named = "state:home", .direction = {1.6, -1.6, 0.6}}),
      portrait("humanoid", "A humanoid",
               "`data/robots/humanoid/humanoid.urdf` has 25 hinges and is designed for walking: its feet are "
               "flat, and the axes of its hips and ankles intersect.",
               {.file = "robots/humanoid/humanoid.urdf",
                .posture = waving(),
                .direction = {1.9, -1.2, 0.5},
                .cell = 0.5}),
      portrait("hand", "A hand",
               "`data/robots/hand/hand.urdf` has fifteen driven hinges; the last joint of each finger "
               "follows the previous one.",
               {.file = "robots/hand/hand.urdf",
                .posture = halfClosed(),
                .direction = {1.6, 1.2, 0.5},
                .cell = 0.05}),
      {"grasp", "The hand holds a ball",
       "Bullet has closed the hand on a ball of 100 g. Dots are contacts; arrows, within the friction cones, "
       "are the forces that carry the ball.",
       grasp},
      portrait("table", "The man of the course at a table",
               "`data/scenes/table.ors` includes the man, moves his targets and adds the table. Inverse "
               "kinematics has moved his hands to the targets.",
               {.file = "scenes/table.ors",
                .reaching = {{"handR", "rightTarget"}, {"handL", "leftTarget"}},
                .direction = {1.6, -1.6, 0.8},
                .cell = 0.5}),
      portrait(
          "pick", "An arm and its gripper",
          "`data/scenes/pick.ors` puts the gripper on the flange of the arm, and the arm on a table.",
          {.file = "scenes/pick.ors", .named = "state:home", .direction = {1.2, -1.4, 0.8}, .cell = 0.5}),
      portrait("board", "A planar arm above a board",
               "`data/scenes/board.ors` is a scene for path "
               "planners.",
               {.file = "scenes/board.ors", .direction = {2, -0.9, 0.7}}),
      portrait("maze", "A cart in four rooms", "`data/scenes/maze.ors` is a scene for path planners.",
               {.file = "scenes/maze.ors", .direction = {-0.9, -1.5, 2.0}, .cell = 0.5})};
}

}  // namespace rex::gallery

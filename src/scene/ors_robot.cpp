#include <unordered_set>

#include <fmt/format.h>

#include "scene/ors_robot_internal.h"

namespace rex::ors {
namespace {

class Placer {
 public:
  explicit Placer(const RobotPlace& place) : place_(place) {}

  void rename(std::string& name) const { name = place_.prefix + name; }
  void renameBody(std::string& name) const {
    name = name == kWorldName ? place_.parent : place_.prefix + name;
  }

  void place(ShapeSpec& shape) const {
    if (!shape.name.empty()) rename(shape.name);
    if (!shape.meshPath.empty())
      shape.meshFile = std::filesystem::proximate(shape.meshPath, place_.folder).generic_string();
  }

  void place(JointSpec& joint) const {
    rename(joint.name);
    rename(joint.child);
    if (joint.parent == kWorldName) joint.X_PF = place_.X_PR * joint.X_PF;
    renameBody(joint.parent);
    if (!joint.mimic.empty()) rename(joint.mimic);
  }

  JointSpec weld(const BodySpec& root) const {
    JointSpec joint;
    joint.name = fmt::format("{}>{}", place_.parent, root.name);
    joint.parent = place_.parent;
    joint.child = root.name;
    joint.type = JointType::kRigid;
    joint.X_PF = place_.X_PR * root.X_WB;
    joint.where = root.where;
    return joint;
  }

 private:
  const RobotPlace& place_;
};

}  // namespace

SceneSpec placedRobot(SceneSpec robot, const RobotPlace& place) {
  const Placer placer(place);
  for (ShapeSpec& shape : robot.worldShapes) {
    placer.place(shape);
    shape.X_BS = place.X_PR * shape.X_BS;
  }
  std::unordered_set<std::string> moved;
  for (JointSpec& joint : robot.joints) {
    placer.place(joint);
    moved.insert(joint.child);
  }
  std::vector<JointSpec> welds;
  for (BodySpec& body : robot.bodies) {
    placer.rename(body.name);
    for (ShapeSpec& shape : body.shapes) placer.place(shape);
    if (moved.contains(body.name)) continue;
    if (place.parent == kWorldName) {
      body.X_WB = place.X_PR * body.X_WB;
    } else {
      welds.push_back(placer.weld(body));
      body.X_WB = {};
    }
  }
  robot.joints.insert(robot.joints.begin(), welds.begin(), welds.end());
  for (CollisionChoice& choice : robot.collisionChoices) {
    placer.renameBody(choice.a);
    if (!choice.b.empty()) placer.renameBody(choice.b);
  }
  return robot;
}

}  // namespace rex::ors

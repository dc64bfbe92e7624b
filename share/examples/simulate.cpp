// A robot dog drops onto the ground and stands: motors hold its legs, Bullet finds the contacts.
#include "course/course.h"
#include "scene/model.h"

using namespace rex;

int main() {
  Simulator S("quadruped", {.freeBase = true});
  S.addObstacle({.type = ShapeType::kBox, .extent = {3, 3, 0.1}}, translation(0, 0, -0.05), "ground");

  // The base has seven numbers, its place and a quaternion; then come the joints.
  Eigen::VectorXd q = S.getJointAngles();
  const std::vector<std::string> joints = S.getJointNames();
  q[2] = 0.5;
  for (int i = 7; i < q.size(); ++i) {
    if (joints[i].ends_with("_hip_pitch")) q[i] = 0.75;
    if (joints[i].ends_with("_knee")) q[i] = -1.5;
    S.setPositionMotor(joints[i], q[i], 40);  // at most 40 N m
  }
  S.setJointAngles(q);
  for (int t = 0; t < 60; ++t) S.stepPhysics(1. / 30);

  double carried = 0;
  for (const SimulatorContact& contact : S.getContacts())
    carried += contact.force * std::abs(contact.normal_W.z());
  print("height of the torso [m]", S.kinematicsPos("torso").z());
  print("the ground carries [N]", carried);
  print("the dog weighs [N]", 9.81 * S.model().mass());
  writeReplay(S, "simulate", {.caption = "a dog that stands"});
}

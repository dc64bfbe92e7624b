// Two fingers that press from both sides.
#include <cmath>

#include "contact/contact_scenes.h"

namespace rex::contact {
namespace {

using Eigen::Vector3d;

void addFinger(SceneSpec& spec, const std::string& name, double x, double direction) {
  BodySpec body;
  body.name = name;
  body.mass = 0.1;
  body.inertia = 1e-4 * Eigen::Matrix3d::Identity();
  ShapeSpec pad;
  pad.name = name;
  pad.shape = boxShape(0.02, 0.06, 0.06);
  pad.contact = true;
  body.shapes.push_back(pad);
  spec.bodies.push_back(body);
  JointSpec joint;
  joint.name = name;
  joint.parent = "world";
  joint.child = name;
  joint.type = JointType::kSlider;
  joint.axis = {direction, 0, 0};
  joint.X_PF.p = {x, 0, 0};
  spec.joints.push_back(joint);
}

// Fingers that close along x on a block of 4 cm.
Model gripper(bool mimics) {
  SceneSpec spec;
  addFinger(spec, "left", -0.03, 1);
  addFinger(spec, "right", 0.03, -1);
  if (mimics) spec.joints.back().mimic = "left";
  addLoose(spec, "block", 0.1, boxShape(0.04, 0.04, 0.04), {});
  return compile(spec);
}

// Whether a block slips out of a grip of 10 N under so many newtons, its weight included.
bool slips(const Engine& engine, double load) {
  const Model model = gripper(false);
  const auto world = engine(model, {.friction = 0.5});
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.nv());
  u[0] = u[1] = 10;
  world->setForces(u);
  u[4] = -(load - 0.1 * kGravity);
  for (int i = 0; i < 500; ++i) {
    world->step();
    if (i == 50) world->setForces(u);
  }
  return world->state().q[4] < -2e-3;
}

double forceOfMimic(const Engine& engine) {
  const Model model = gripper(true);
  const auto world = engine(model, {.friction = 0.8});
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.nv());
  u[0] = 20;
  world->setForces(u);
  world->run(0.5);
  return world->normalForce(shapeNamed(model, "right"));
}

}  // namespace

std::vector<ContactScene> grippingScenes() {
  return {{.name = "grip",
           .quantity = "load at which a block slips out of a grip of 10 N",
           .law = "2 mu F",
           .unit = "N",
           .formula = 10,
           .reached = 0.1,
           .measured =
               [](const Engine& engine) {
                 return turningPoint(8, 12, 0.01, [&](double load) { return slips(engine, load); });
               },
           .model = gripper(false),
           .needsRigidity = true},
          {.name = "mimic",
           .quantity = "what a finger presses with that mimics one driven by 20 N",
           .law = "F / 2",
           .unit = "N",
           .formula = 10,
           .reached = 0.05,
           .measured = forceOfMimic,
           .model = gripper(true)}};
}

}  // namespace rex::contact

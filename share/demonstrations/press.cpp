// Chapter 3: Pressing and wiping. An arm wipes a table in a physics engine and presses with the force that is
// wanted, because its torques come from motion and force together. Sliders change the force, the speed and
// the friction; a button makes up for friction.
// Slides: 3:36
// Formula: τ = JᵀF + the torques of the motion along the table
// Try: An arm wipes a table and presses with 20 N. Set "friction" to 0.6 and switch off its compensation:
// the force is wrong by half.
#include "control/operational_contacts.h"
#include "course/course.h"
#include "course/live_view.h"
#include "kinematics/task_maps.h"
#include "physics/physics_world.h"
#include "render/picture.h"

using namespace rex;

int main() {
  const Eigen::Vector3d centre(0, -1.6, 1);  // of the table's top
  Simulator scene("arm7");
  scene.addObstacle({.type = ShapeType::kBox, .extent = {1.2, 1.2, 0.1}}, translation(0, -1.6, 0.95),
                    "table");
  const Model& model = scene.model();
  const BodyId last = model.body("arm7");
  const TaskMap tip = positionTask(last, {0, 0, 0.2});  // the centre of a ball of 10 cm
  const TaskMap place = taskRows(tip, 0, 2), height = taskRows(tip, 2, 1);
  State now = initialState(model);
  now.q << -0.3, 0.6, 0.9, 0.5, 0.7, 0.3, 0.2;
  const Eigen::VectorXd posture = now.q;
  LiveView view("press");
  view.lookFrom({0.8, -1, 0.5});
  std::optional<PhysicsWorld> world;
  double phase = 0, rubs = -1;
  bool makesUp = true;
  std::vector<Eigen::Vector3d> wiped;
  for (int t = 0; t < 360 || view.isWatched(); ++t) {
    const double force = view.slider("force [N]", 0, 60, 20), rate = view.slider("speed [rad/s]", 0, 4, 1.5),
                 friction = view.slider("friction", 0, 0.6, 0.2);
    if (view.button("make up for friction or not")) makesUp = !makesUp;
    if (!world || friction != rubs) {
      world.emplace(model, PhysicsOptions{.friction = friction});
      world->setState(now);
      rubs = friction;
    }
    double felt = 0;
    for (int i = 0; i < 33; ++i) {
      phase += rate * 1e-3;
      const Eigen::Vector2d ahead(std::cos(phase), std::sin(phase)), aside(-ahead.y(), ahead.x());
      const OperationalTask along{.task = {.map = place, .target = centre.head(2) + 0.25 * ahead},
                                  .gains = pdGains(1, 0.15, 1),
                                  .velocity = 0.25 * rate * aside},
          down{.task = {.map = height, .target = Eigen::VectorXd::Constant(1, centre.z() + 0.08)},
               .gains = pdGains(1, 0.5, 1)},
          rest{.task = {.map = homingTask(posture)}, .gains = pdGains(1, 0.6, 1)};
      const OperationalContact table{.map = height, .force = Eigen::VectorXd::Constant(1, force)};
      const std::vector<PhysicsContact> touch = world->contacts();
      Eigen::VectorXd u;
      if (touch.empty()) {
        u = prioritisedForces(model, now, std::vector{along, down, rest}, {.damping = 0.1});
      } else {
        u = forcesInContact(model, now, {&table, 1}, std::vector{along, rest}, {.damping = 0.1});
        const BodyPoses poses = forwardKinematics(model, now.q);
        TaskValue point;  // that touches; friction pulls it against its motion
        positionTask(last, poses[last].inverse() * touch[0].p_WA)({model, now.q, poses}, point);
        const Eigen::Vector3d v = point.J * now.v;
        if (makesUp) u += friction * force * point.J.transpose() * v / std::max(v.norm(), 0.02);
      }
      std::vector<Motor> motors(7);
      for (int k = 0; k < 7; ++k) motors[k].target = u[k];
      world->setMotors(motors);
      world->step(1e-3);
      now = world->state();
      for (const PhysicsContact& one : world->contacts()) felt += one.impulse / 1e-3 / 33;
    }
    view.plot("wanted [N]", t / 30., force);
    view.plot("pressed [N]", t / 30., felt);
    Picture picture = scenePicture(model, forwardKinematics(model, now.q));
    for (const PhysicsContact& one : world->contacts()) {
      wiped.push_back(one.p_WA + Eigen::Vector3d(0, 0, 0.004));
      picture.arrows.push_back({.from = one.p_WA,
                                .to = one.p_WA + Eigen::Vector3d(0, 0, 0.02 * felt),
                                .color = {0.80f, 0.47f, 0.65f},
                                .radius = 0.02});
    }
    if (wiped.size() > 150) wiped.erase(wiped.begin());
    if (wiped.size() > 1)
      picture.polylines.push_back({.points = wiped, .color = {0, 0.45f, 0.7f}, .width = 4});
    view.show(picture);
  }
}

// Chapter 3: Computed torque against PD. Two equal arms follow the same motion (pale): the left one by PD for
// each joint alone, the right one with the torques that its equation of motion asks for. Sliders change speed
// and gains.
// Slides: 3:29
// Formula: u = M(q) (q''* + Kp (q* - q) + Kd (q'* - q')) + F(q, q')
// Try: The arm under PD lags and sags, the one under computed torque does not. Raise "speed".
#include "control/computed_torque.h"
#include "course/course.h"
#include "course/live_view.h"
#include "render/picture.h"

using namespace rex;

int main() {
  LiveView view("torque");
  Simulator arms[] = {Simulator("arm3"), Simulator("arm3")};
  const Model& model = arms[0].model();
  const Eigen::VectorXd middle = Eigen::Vector3d(0.2, 0.5, 0.6);
  double phase = 0;
  for (Simulator& one : arms) one.setJointAngles(middle);
  for (int t = 0; t < 300 || view.isWatched(); ++t) {
    const double rate = view.slider("speed [rad/s]", 0, 6, 2.5);
    const PdGains gains =
        pdGains(1, view.slider("wave length [s]", 0.03, 0.5, 0.15), view.slider("damping", 0, 2, 1));
    Reference wanted;
    for (int i = 0; i < 10; ++i) {
      phase += rate / 300;
      const Eigen::VectorXd swing = Eigen::Vector3d(0.5, 0.6, -0.8);
      wanted = {.q = middle + std::sin(phase) * swing,
                .v = rate * std::cos(phase) * swing,
                .a = -rate * rate * std::sin(phase) * swing};
      for (int k = 0; k < 2; ++k) {
        Simulator& arm = arms[k];
        const State now{.q = arm.getJointAngles(), .v = arm.getJointVels()};
        Eigen::VectorXd u = computedTorque(model, now, wanted, gains);
        if (k == 0) u = gains.Kp * (wanted.q - now.q) + gains.Kd * (wanted.v - now.v);
        arm.stepDynamics(u, 1. / 300);
      }
    }
    Picture picture = scenePicture(model, forwardKinematics(model, wanted.q));
    const std::vector<Solid> pale = picture.solids;
    picture.solids.clear();
    for (int k = 0; k < 2; ++k) {
      const Pose place = translation(k == 0 ? -0.9 : 0.9, 0, 0);
      for (Solid one : pale) one.X_WS = place * one.X_WS, one.color.a = 0.25f, picture.solids.push_back(one);
      for (Solid one : placedSolids(model, forwardKinematics(model, arms[k].getJointAngles())))
        one.X_WS = place * one.X_WS, picture.solids.push_back(one);
      picture.labels.push_back({.text = k == 0 ? "PD" : "computed torque",
                                .p_WQ = place.p + Eigen::Vector3d(0, 0, 1.55),
                                .scale = 2});
      view.plot(k == 0 ? "error of PD [rad]" : "error of computed torque [rad]", t / 30.,
                (wanted.q - arms[k].getJointAngles()).norm());
    }
    view.show(picture);
  }
}

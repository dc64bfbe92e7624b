// Chapter 2: Inverse kinematics and the nullspace. The hand of an arm with seven joints follows a target that
// the mouse moves; the elbow swings in the nullspace, which does not move the hand. Too little damping shakes
// out of reach.
// Slides: 2:36
// Formula: dq = J# dy + (I - J# J) dq_0
// Try: A hand stays at its target while the elbow swings. Drag the target out of reach and "damping" down
// to 0.001: the arm oscillates.
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "kinematics/forward_kinematics.h"
#include "kinematics/inverse_kinematics.h"
#include "render/picture.h"

using namespace rex;

int main() {
  Simulator S("arm7dof");
  LiveView view("nullspace");
  const Eigen::VectorXd rest = S.inverseKinematics("tool", Eigen::Vector3d(0.45, 0, 0.45)).q;
  S.setJointAngles(rest);
  std::vector<Eigen::Vector3d> way;
  for (int t = 0; t < 360 || view.isWatched(); ++t) {
    const Eigen::Vector3d middle = view.handle("target", {0.45, 0, 0.45});
    const double circle = view.slider("circle [m]", 0, 0.3, 0.15);
    const double swing = view.slider("nullspace motion", 0, 1, 0.5),
                 damping = view.slider("damping", 0.001, 0.5, 0.05);
    // Four seconds each: the hand moves, the elbow moves, both move.
    const int act = t / 120 % 3;
    const double angle = act == 1 ? 0 : t / 19.0986;  // 120 frames are one turn
    const Eigen::Vector3d target = middle + circle * Eigen::Vector3d(0, std::sin(angle), std::cos(angle) - 1);
    Eigen::VectorXd q = S.getJointAngles();
    Eigen::VectorXd wish = 0.02 * (rest - q);
    if (act > 0) wish[2] += 0.06 * swing * std::cos(t / 9.5493);
    const Eigen::MatrixXd J = S.jacobianPos("tool"), C = Eigen::Matrix3d::Identity() / (damping * damping);
    q += inverseKinematicsStep(J, 0.3 * (target - S.kinematicsPos("tool")),
                               {.C = C, .a = Eigen::VectorXd::Zero(7)});
    const Eigen::MatrixXd pull =
        J.transpose() * inverse(J * J.transpose() + 1e-4 * Eigen::Matrix3d::Identity());
    q += wish - pull * (J * wish);  // (I - J# J) wish
    S.setJointAngles(q);
    way.push_back(S.kinematicsPos("tool"));
    if (way.size() > 120) way.erase(way.begin());

    Picture picture = scenePicture(S.model(), forwardKinematics(S.model(), q));
    picture.solids.push_back({{.type = ShapeType::kSphere, .radius = 0.03},
                              translation(target.x(), target.y(), target.z()),
                              kDeadReckoningColor,
                              "target"});
    picture.polylines.push_back({.points = way, .color = kEstimateColor});
    const char* says[] = {"the hand follows the target", "the elbow moves, the hand stands still",
                          "both move"};
    const double away = (target - way.back()).norm();
    picture.captions.push_back({.text = away > 0.1 ? "the target is out of reach" : says[act], .scale = 1.5});
    view.plot("hand to target [m]", t / 30., away);
    view.plot("joint 3 [rad]", t / 30., q[2]);
    view.show(picture);
  }
}

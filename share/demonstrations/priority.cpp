// Chapter 2: Priorities of tasks. A man reaches for two targets (orange: right hand, green: left) that drift
// apart and that the mouse moves: the hand that comes first reaches its target, the other one does what is
// left. A button swaps them.
// Slides: 2:50, 2:51
// Formula: dq_2 = dq_1 + (J_2 N_1)# (dy_2 - J_2 dq_1), N_1 = I - J_1# J_1
// Try: Two targets drift apart; the hand with priority keeps its own. Press "swap priorities".
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "kinematics/forward_kinematics.h"
#include "kinematics/hierarchical_step.h"
#include "render/picture.h"

using namespace rex;

int main() {
  Simulator S("man");
  LiveView view("priority");
  const Eigen::VectorXd rest = S.getJointAngles();
  const Eigen::Vector3d right = S.kinematicsPos("handR"), left = S.kinematicsPos("handL");
  bool rightFirst = true;
  for (int t = 0; t < 360 || view.isWatched(); ++t) {
    const Eigen::Vector3d goals[] = {view.handle("right", right + Eigen::Vector3d(-0.6, 0, 0.1)),
                                     view.handle("left", left + Eigen::Vector3d(0.6, 0, 0.1))};
    if (view.button("swap priorities") || (t == 200 && !view.isWatched())) rightFirst = !rightFirst;
    const double share = std::min(1., t / 100.);
    const Eigen::Vector3d targets[] = {right + share * (goals[0] - right), left + share * (goals[1] - left)};
    const char* hands[] = {"handR", "handL"};
    Eigen::VectorXd q = S.getJointAngles();
    std::vector<TaskLevel> levels;
    for (const int k : {rightFirst ? 0 : 1, rightFirst ? 1 : 0})
      levels.push_back({.J = S.jacobianPos(hands[k]), .dy = 0.1 * (targets[k] - S.kinematicsPos(hands[k]))});
    q += hierarchicalStep(levels, {.a = 0.02 * (rest - q), .damping = 0.2});
    S.setJointAngles(q);

    Picture picture = scenePicture(S.model(), forwardKinematics(S.model(), q));
    std::erase_if(picture.solids,
                  [](const Solid& one) { return one.name.find("Target") != std::string::npos; });
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector3d hand = S.kinematicsPos(hands[k]), &target = targets[k];
      const Color color = k == 0 ? kDeadReckoningColor : kLandmarkColor;
      picture.solids.push_back({{.type = ShapeType::kSphere, .radius = 0.06},
                                translation(target.x(), target.y(), target.z()),
                                color,
                                "target"});
      picture.polylines.push_back({.points = {hand, target}, .color = color, .width = 4});
      view.plot(k == 0 ? "error of the right hand [m]" : "error of the left hand [m]", t / 30.,
                (target - hand).norm());
    }
    picture.captions.push_back(
        {.text = rightFirst ? "first: right hand (orange)" : "first: left hand (green)", .scale = 1.5});
    view.show(picture);
  }
}

// Chapter 11: Static walking. A humanoid shifts its centre of mass over one foot before it lifts the other:
// it may stop at any time without falling. After each step the other foot becomes the root of its joints.
// Sliders change the steps and how far it leans.
// Slides: 11:7, 2:61
// Formula: the centre of mass projected onto the floor is inside the support polygon
// Try: A humanoid walks statically: its centre of mass (blue) stays inside the support polygon (green). Set
// "lean" to 0.3.
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "kinematics/forward_kinematics.h"
#include "kinematics/inverse_kinematics.h"
#include "locomotion/footsteps.h"
#include "render/picture.h"

using namespace rex;

const Eigen::Vector3d sole(0.03, 0, -0.075);  // its centre in a foot, whose size is 0.24 x 0.11 m

// A stack of tasks: rows that pull values of the robot to their targets.
struct Stack {
  Eigen::MatrixXd J;
  Eigen::VectorXd error;

  void add(const Eigen::VectorXd& off, const Eigen::MatrixXd& jacobian) {
    const Eigen::Index rows = error.size(), more = off.size();
    J.conservativeResize(rows + more, jacobian.cols());
    error.conservativeResize(rows + more);
    J.bottomRows(more) = jacobian;
    error.tail(more) = off;
  }
};

// One step of inverse kinematics: the swinging sole at its place and flat, the pelvis upright and at its
// height, the mass above `under`. The other foot is the root and cannot move.
void move(Simulator& S, const std::string& swinging, const Eigen::Vector3d& place,
          const Eigen::Vector2d& under, double height) {
  Stack all;
  all.add(under - S.kinematicsCOM(), S.jacobianCOM());
  all.add(place - S.kinematicsPos(swinging, sole), S.jacobianPos(swinging, sole));
  for (const std::string& body : {swinging, std::string("pelvis")})
    for (const int axis : {0, 2}) {
      const Eigen::Vector3d e = Eigen::Vector3d::Unit(axis);
      all.add(e - S.kinematicsVec(body, e), S.jacobianVec(body, e));
    }
  all.add(Eigen::VectorXd::Constant(1, height - S.kinematicsPos("pelvis").z()),
          S.jacobianPos("pelvis").bottomRows(1));
  S.setJointAngles(S.getJointAngles() + inverseKinematicsStep(all.J, all.error, 0.01));
}

int main() {
  Simulator S("humanoid");
  std::string stand = "left_foot", swing = "right_foot";
  const double ground = S.kinematicsPos(stand, sole).z();
  S.anchorKinematicChainIn(stand);
  const double height = S.kinematicsPos("pelvis").z() - 0.06;
  LiveView view("balance");
  view.lookFrom({1, -1, 0.5});
  Eigen::Vector3d from = S.kinematicsPos(swing, sole), to = from + Eigen::Vector3d(0.1, 0, 0);
  Eigen::Vector2d lean = S.kinematicsCOM();
  double share = 0;  // of this step: shift until 1, swing until 2
  for (int t = 0; t < 420 || view.isWatched(); ++t) {
    const double length = view.slider("length of steps [m]", 0, 0.3, 0.2),
                 pace = view.slider("pace", 0.1, 2, 1), lift = view.slider("lift [m]", 0.02, 0.15, 0.06),
                 over = view.slider("lean", 0, 1, 0.9);
    const Eigen::Vector3d place = S.kinematicsPos(stand, sole);
    share += pace / 40;
    if (share >= 2) {
      S.anchorKinematicChainIn(swing);
      std::swap(stand, swing);
      share = 0, lean = S.kinematicsCOM();
      from = S.kinematicsPos(swing, sole), to = {S.kinematicsPos(stand, sole).x() + length, from.y(), ground};
    }
    const bool swings = share > 1;
    const double s = swings ? share - 1 : share, smooth = s * s * (3 - 2 * s);
    const Eigen::Vector2d middle = (place + from).head(2) / 2,
                          aim = middle + over * (S.kinematicsPos(stand, sole).head(2) - middle);
    Eigen::Vector3d foot = from;
    if (swings) foot += smooth * (to - from) + Eigen::Vector3d(0, 0, 4 * lift * s * (1 - s));
    for (int i = 0; i < 3; ++i) move(S, swing, foot, swings ? aim : lean + smooth * (aim - lean), height);

    Eigen::Matrix2Xd corners(2, swings ? 4 : 8);
    int k = 0;
    for (const std::string& one : {stand, swing})
      for (const double x : {-0.12, 0.12})
        for (const double y : {-0.055, 0.055})
          if (k < corners.cols())
            corners.col(k++) = S.kinematicsPos(one, sole + Eigen::Vector3d(x, y, 0)).head(2);
    const SupportPolygon support = supportPolygon(corners);
    const Eigen::Vector2d mass = S.kinematicsCOM();
    const double margin = supportMargin(support, mass).margin;
    view.plot("margin of the centre of mass [m]", t / 30., margin);
    Picture picture = scenePicture(S.model(), forwardKinematics(S.model(), S.getJointAngles()));
    picture.ground.height = ground;
    Polyline edge{.color = margin > 0 ? kLandmarkColor : kDeadReckoningColor, .width = 5};
    for (Eigen::Index i = 0; i <= support.corners.cols(); ++i) {
      const Eigen::Vector2d corner = support.corners.col(i % support.corners.cols());
      edge.points.push_back({corner.x(), corner.y(), ground + 0.005});
    }
    picture.polylines.push_back(edge);
    picture.polylines.push_back(
        {.points = {{mass.x(), mass.y(), ground + 0.005}, {mass.x(), mass.y(), height}},
         .color = kEstimateColor,
         .width = 4});
    picture.captions.push_back({.text = margin > 0 ? "stands" : "would fall", .scale = 1.5});
    view.show(picture);
  }
}

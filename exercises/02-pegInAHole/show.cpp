#include "show.h"

#include <algorithm>
#include <cmath>

#include "kinematics/hierarchical_step.h"

using namespace rex;

namespace {

Eigen::Vector3d onCircle(const Eigen::Vector3d& center, int t) {
  return center + 0.2 * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
}

// f(S, t) in each posture of a motion, t = 1, 2, ...; if the motion is still empty, in the start posture.
template <class F>
std::vector<double> along(Simulator S, const Postures& motion, const F& f) {
  std::vector<double> values;
  for (const Eigen::VectorXd& q : motion) {
    S.setJointAngles(q);
    values.push_back(f(S, static_cast<int>(values.size()) + 1));
  }
  if (motion.empty()) values.push_back(f(S, 1));
  return values;
}

// A logarithmic axis cannot show zero.
std::vector<double> positive(std::vector<double> values) {
  for (double& value : values) value = std::max(value, 1e-16);
  return values;
}

std::vector<double> errorsOnCircle(const Postures& motion, const Eigen::Vector3d& center) {
  return positive(along(Simulator("man.ors"), motion, [&](const Simulator& S, int t) {
    return (S.kinematicsPos("handR") - onCircle(center, t)).norm();
  }));
}

// Steps 1, 2, ... of a robot: step(t) is the change of its posture.
template <class Step>
Postures moved(Simulator& S, int steps, const Step& step) {
  Postures motion;
  for (int t = 1; t <= steps; ++t) {
    S.setJointAngles(S.getJointAngles() + step(t));
    motion.push_back(S.getJointAngles());
  }
  return motion;
}

// The hand should circle. With lower priority it should stay where it was, and its z axis should point
// upwards.
struct TwoWishes {
  Eigen::MatrixXd J1;
  Eigen::VectorXd dy1;
  Eigen::MatrixXd J2;
  Eigen::VectorXd dy2;
};

// `step` gives dq from the wishes. Returns the errors on the circle.
template <class Step>
std::vector<double> errorsWithTwoWishes(const Eigen::Vector3d& center, const Step& step) {
  Simulator S("man.ors");
  const Eigen::Vector3d start = S.kinematicsPos("handR");
  const Postures motion = moved(S, 380, [&](int t) {
    TwoWishes wishes{S.jacobianPos("handR"), onCircle(center, t) - S.kinematicsPos("handR"),
                     Eigen::MatrixXd(6, S.getJointDimension()), Eigen::VectorXd(6)};
    wishes.J2 << S.jacobianPos("handR"), S.jacobianVec("handR");
    wishes.dy2 << start - S.kinematicsPos("handR"), Eigen::Vector3d::UnitZ() - S.kinematicsVec("handR");
    wishes.dy2 *= 0.1;  // a tenth of the wish at a time, so that the steps stay small
    return step(wishes);
  });
  return errorsOnCircle(motion, center);
}

const PictureOptions kLook{
    .caption = "The peg on its way into the hole", .traces = {"peg"}, .view = {1, -1, 0.7}};

}  // namespace

void showCircles(const Postures& longRun, const Simulator& turns, const Eigen::Vector3d& center) {
  // The circle of exercise 01, with no other task: nothing determines which posture to prefer.
  const Simulator man("man.ors");
  Simulator alone = man;
  const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(27, 27);
  const Postures lost = moved(alone, 2000, [&](int t) {
    return multiTaskStep(
        {{alone.kinematicsPos("handR") - onCircle(center, t), alone.jacobianPos("handR"), 1e4}}, W);
  });
  std::vector<Eigen::Vector3d> wholeCircle;
  for (int t = 0; t <= 126; ++t) wholeCircle.push_back(onCircle(center, t));
  const auto length = [](const Simulator& S, int) { return S.getJointAngles().norm(); };
  const auto tilt = [](const Simulator& S, int) {
    return (S.kinematicsVec("handL") - Eigen::Vector3d::UnitZ()).norm();
  };
  const Figure errors{
      .title = "Following the circle",
      .xLabel = "step",
      .yLabel = "tracking error [m]",
      .logY = true,
      .legend = Legend::kBottomRight,
      .series = {{.label = "circle alone", .y = errorsOnCircle(lost, center)},
                 {.label = "with home and pointing tasks", .y = errorsOnCircle(longRun, center)}}};
  const Figure posture{
      .title = "How far the posture is from home",
      .xLabel = "step",
      .yLabel = "length of q [rad]",
      .legend = Legend::kTopLeft,
      .series = {{.label = "circle alone", .y = along(man, lost, length)},
                 {.label = "with home and pointing tasks", .y = along(man, longRun, length)}}};
  const Figure pointing{.title = "How far the left hand is from pointing upwards",
                        .xLabel = "step",
                        .yLabel = "|z axis - up|",
                        .logY = true,
                        .series = {{.y = positive(along(man, longRun, tilt))}}};
  plot("circle", errors);
  plot("posture", posture);
  plot("pointing", pointing);
  alone.watch("circle_alone_after_2000_steps");
  const PictureOptions look{
      .caption = "12.4.2: a circle, home, and the left hand up", .traces = {"handR"}, .paths = {wholeCircle}};
  writeVideo(turns, "circle", look);
  writeReplay(turns, "circle", look, {errors, posture, pointing});
}

void showPosture(const Eigen::VectorXd& q) {
  Simulator S("pegInAHole.ors");
  S.setJointAngles(q);
  print("peg, which should be at (0, -1, 1.5)", S.kinematicsPos("peg"));
  print("its direction, which should be (0, 0, -1)", S.kinematicsVec("peg"));
  PictureOptions look = kLook;
  look.caption = "The peg above the hole";
  writePicture(S, "peg_posture.png", look);
}

Figure showInterpolation(const Postures& inJointSpace, const Postures& inTaskSpace,
                         const Eigen::Vector3d& hole, double margin) {
  Simulator S("pegInAHole.ors");
  S.setContactMargin(margin);
  const auto both = [&](const auto& f) -> std::vector<Series> {
    return {{.label = "joint space", .y = along(S, inJointSpace, f)},
            {.label = "task space", .y = along(S, inTaskSpace, f)}};
  };
  plot("interpolation", {.title = "From above the hole into it",
                         .xLabel = "step",
                         .yLabel = "distance of the peg from the axis of the hole [m]",
                         .series = both([&](const Simulator& at, int) {
                           return (at.kinematicsPos("peg") - hole).head<2>().norm();
                         })});
  const Figure contacts{
      .title = "Coming too close",
      .xLabel = "step",
      .yLabel = "contact cost, margin 0.02 m",
      .series = both([](const Simulator& at, int) { return at.kinematicsContacts().sum(); })};
  plot("contacts", contacts);
  return contacts;
}

void showInsertion(const Simulator& start, const Postures& motion, const Figure& contacts) {
  Simulator film("pegInAHole.ors");
  film.setJointAngles(start.getJointAngles());
  for (const Eigen::VectorXd& q : motion) film.setJointAngles(q);
  print("peg, which should end at (0, -1, 1)", film.kinematicsPos("peg"));
  film.reportProxies();
  writeVideo(film, "peg", kLook);
  writeContactSheet(film, "peg_sheet", kLook);
  writeReplay(film, "peg", kLook, {contacts});
}

void showPriority(const Eigen::Vector3d& center) {
  const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(27, 27);
  const auto weighted = [&](const TwoWishes& wishes) {
    return multiTaskStep({{-wishes.dy1, wishes.J1, 1e4}, {-wishes.dy2, wishes.J2, 1e3}}, W);
  };
  const auto strict = [](const TwoWishes& wishes) {
    return priorityStep(wishes.J1, wishes.dy1, wishes.J2, wishes.dy2);
  };
  const auto byLibrary = [](const TwoWishes& wishes) {
    return hierarchicalStep({{wishes.J1, wishes.dy1}, {wishes.J2, wishes.dy2}});
  };
  plot("priority",
       {.title = "A second task that pulls the hand away",
        .xLabel = "step",
        .yLabel = "tracking error [m]",
        .logY = true,
        .series = {
            {.label = "weights 10 : 1", .y = errorsWithTwoWishes(center, weighted)},
            {.label = "strict priority", .y = errorsWithTwoWishes(center, strict)},
            {.label = "strict, library", .y = errorsWithTwoWishes(center, byLibrary), .dashed = true}}});
}

#include "show.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "course/film.h"
#include "kinematics/hierarchical_step.h"
#include "kinematics/motion_profile.h"
#include "scene/model.h"

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

void showProfiles() {
  const std::pair<const char*, MotionProfile> shapes[] = {
      {"ramp", {ProfileShape::kRamp}},
      {"sine", {ProfileShape::kSine}},
      {"trapezoid, blend 1/4", {ProfileShape::kTrapezoid}},
      {"minimum jerk", {ProfileShape::kMinimumJerk}}};
  const auto compare = [&](const std::string& name, const std::string& label, double ProfilePoint::*number) {
    Figure figure{.title = "One metre in one second",
                  .xLabel = "time [s]",
                  .yLabel = label,
                  .legend = Legend::kOutside};
    for (const auto& [shape, profile] : shapes) {
      Series series{.label = shape, .size = 1.5};
      for (int i = -100; i <= 1100; ++i) series.add(i / 1000., profileAt(profile, i / 1000.).*number);
      figure.series.push_back(series);
    }
    if (name == "profile_position") {
      Series yours{.label = "yours", .dashed = true, .color = Color{0, 0, 0}};
      for (int i = 0; i <= 100; ++i) yours.add(i / 100., sineProfile(i / 100.));
      figure.series.push_back(yours);
    }
    plot(name, figure);
  };
  compare("profile_position", "position [m]", &ProfilePoint::position);
  compare("profile_velocity", "velocity [m/s]", &ProfilePoint::velocity);
  compare("profile_acceleration", "acceleration [m/s^2]", &ProfilePoint::acceleration);
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

namespace {

// man.ors on its own right foot, with limits for the joints of its legs, radians, and without the red balls.
Simulator standingMan() {
  SimulatorDescription scene = Simulator("man.ors").description();
  std::string& text = scene.sceneText;
  for (const auto& [joint, range] :
       {std::pair("(waist back)", "-0.8 0.8"), std::pair("(back chest)", "-0.8 0.8"),
        std::pair("(chest shoulders)", "-0.8 0.8"), std::pair("(lhip lup)", "-1.5 1.5"),
        std::pair("(rhip rup)", "-1.5 1.5"), std::pair("(lup ldn)", "-1.8 0.65"),
        std::pair("(rup rdn)", "-1.8 0.65"), std::pair("(ldn lfoot)", "-0.7 0.7"),
        std::pair("(rdn rfoot)", "-0.7 0.7")})
    text.insert(text.find("{", text.find(joint)) + 1, " limits=[" + std::string(range) + "]");
  text.resize(text.find("# where the hands shall reach"));
  Simulator S(scene);
  S.anchorKinematicChainIn("rfoot");
  return S;
}

std::vector<BodyMass> massesOf(const Simulator& S) {
  std::vector<BodyMass> masses;
  for (const Body& one : S.model().bodies()) masses.push_back({one.name, one.mass, one.p_BBcm});
  masses.erase(masses.begin());  // the world
  return masses;
}

// Which of your maps are tasks, too.
struct Wishes {
  bool isBalanced = false, isWithinLimits = false, isHandOnHip = false;
};

// The right hand goes to `target` in 150 steps and stays there, and the left foot stays where it is. If
// wished, the centre of mass stays above the middle of the feet, joints keep away from their limits, and the
// left hand goes to the hip.
Postures reach(Simulator S, const Eigen::Vector3d& target, const Wishes& wishes) {
  const Simulator start = S;
  const std::vector<BodyMass> masses = massesOf(S);
  const Eigen::VectorXd home = S.getJointAngles(), noCost = Eigen::VectorXd::Zero(1);
  const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(home.size(), home.size());
  const Eigen::Vector3d right = S.kinematicsPos("handR"), zero = Eigen::Vector3d::Zero(),
                        hip(-0.02, 0.02, 0.22);
  const Eigen::VectorXd left = relativePosition(S, "handL", zero, "waist", zero).y;
  const Eigen::Vector2d middle = 0.5 * (S.kinematicsPos("lfoot") + S.kinematicsPos("rfoot")).head<2>();
  return moved(S, 200, [&](int t) {
    const double s = sineProfile(std::min(1., t / 150.));
    std::vector<TaskTerm> tasks;
    const auto add = [&](const TaskMapValue& map, const Eigen::VectorXd& wanted, double precision) {
      tasks.push_back({map.y.head(wanted.size()) - wanted, map.J.topRows(wanted.size()), precision});
    };
    add({S.kinematicsPos("handR"), S.jacobianPos("handR")}, right + s * (target - right), 1e4);
    add({S.getJointAngles(), W}, home, 0.1);
    for (const Eigen::Vector3d& point : {Eigen::Vector3d(0, 0.1, 0), {0.05, -0.1, 0}, {-0.05, -0.1, 0}})
      add({S.kinematicsPos("lfoot", point), S.jacobianPos("lfoot", point)},
          start.kinematicsPos("lfoot", point), 1e5);
    if (wishes.isBalanced) add(massCenter(S, masses), middle, 1e4);
    if (wishes.isWithinLimits) add(jointLimits(S, 0.2), noCost, 0.5);
    if (wishes.isHandOnHip)
      add(relativePosition(S, "handL", zero, "waist", zero), left + s * (hip - left), 1e3);
    return multiTaskStep(tasks, W);
  });
}

// The plumb line of the centre of mass.
std::vector<Eigen::Vector3d> plumbLine(const Simulator& S) {
  const Eigen::Vector2d under = S.kinematicsCOM();
  return {{under.x(), under.y(), 0}, {under.x(), under.y(), 1}};
}

}  // namespace

void showBalance(const Eigen::Vector3d& target) {
  const Simulator start = standingMan();
  const Postures alone = reach(start, target, {}), standing = reach(start, target, {true, false, false}),
                 all = reach(start, target, {true, true, true});
  const double middle = start.kinematicsPos("rfoot").y();
  const auto curves = [&](const auto& f) -> std::vector<Series> {
    return {{.label = "hand alone", .y = along(start, alone, f)},
            {.label = "with the centre of mass", .y = along(start, standing, f)},
            {.label = "with all three maps", .y = along(start, all, f), .dashed = true}};
  };
  plot("balance", {.title = "Reaching for the floor",
                   .xLabel = "step",
                   .yLabel = "centre of mass in front of the middle of the feet [m]",
                   .legend = Legend::kTopLeft,
                   .series = curves([&](const Simulator& S, int) { return middle - S.kinematicsCOM().y(); }),
                   .horizontalLines = {{.at = 0.15, .label = "toes"}, {.at = -0.15, .label = "heels"}}});
  plot("limits", {.title = "Reaching for the floor",
                  .xLabel = "step",
                  .yLabel = "cost of joint limits, margin 0.2 rad",
                  .legend = Legend::kTopLeft,
                  .series = curves([](const Simulator& S, int) { return jointLimits(S, 0.2).y[0]; })});

  PictureOptions look{.traces = {"handR"}, .points = {target}, .view = {1.5, -1.2, 0.5}};
  const auto picture = [&](const std::string& name, const std::string& caption, const Postures& motion) {
    Simulator S = start;
    for (const Eigen::VectorXd& q : motion) S.setJointAngles(q);
    PictureOptions options = look;
    options.caption = caption;
    options.paths = {plumbLine(S)};
    writePicture(S, name + ".png", options);
  };
  picture("reach_alone", "The hand alone: he falls", alone);
  picture("reach_balanced", "With all three maps", all);
  look.caption = "Centre of mass, joint limits, and a hand on the hip";
  Film film = makeFilm(start, all, look);
  Simulator S = start;
  for (std::size_t t = 0; t < film.size(); ++t) {
    S.setJointAngles(all[t]);
    film[t].picture.polylines.push_back({.points = plumbLine(S), .color = {0.35f, 0.40f, 0.46f}});
  }
  writeFilmVideo(film, {.camera = cameraFor(film, look)}, "balance", kFilmRate);
}

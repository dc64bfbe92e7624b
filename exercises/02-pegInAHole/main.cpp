#include <algorithm>
#include <cmath>
#include <numbers>

#include "exercise.h"
#include "kinematics/hierarchical_step.h"

using namespace rex;

Eigen::MatrixXd regularisedInverse(const Eigen::MatrixXd& J, const Eigen::MatrixXd& W, double precision) {
  // TODO: slide 2:29 with C = precision * Id. solve(A, B) gives the X with A X = B.
  return Eigen::MatrixXd::Zero(J.cols(), J.rows());
}

Eigen::MatrixXd nullspaceProjector(const Eigen::MatrixXd& J) {
  // TODO: what is J# J for infinite precision? svd(J) tells which directions of q change y at all.
  return Eigen::MatrixXd::Identity(J.cols(), J.cols());
}

Eigen::VectorXd multiTaskStep(const std::vector<TaskTerm>& tasks, const Eigen::MatrixXd& W) {
  // TODO: slides 2:47 and 2:48, with the step dq = q* - q0.
  return Eigen::VectorXd::Zero(W.rows());
}

std::vector<Eigen::VectorXd> circleWithTasks(Simulator& S, const std::string& hand,
                                             const Eigen::Vector3d& center, double radius,
                                             const std::string& pointing, int T) {
  const int n = S.getJointDimension();
  const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(n, n);
  std::vector<Eigen::VectorXd> postures;
  // TODO: T steps, each with three tasks at the present posture: the circle, pointing upwards, and the
  // posture of S before the first step. What is the Jacobian of q itself?
  return postures;
}

double sineProfile(double s) {
  // TODO: slide 2:40.
  return 0;
}

std::vector<Eigen::VectorXd> jointSpaceMotion(const Eigen::VectorXd& q0, const Eigen::VectorXd& qT, int T) {
  std::vector<Eigen::VectorXd> postures;
  // TODO: slide 2:41, step 2.
  return postures;
}

Eigen::VectorXd pegPosture(Simulator& S, const std::string& peg, const Eigen::Vector3d& place,
                           const Eigen::Vector3d& direction, double margin) {
  S.setContactMargin(margin);
  // TODO: many multiTaskSteps. Each goes a small part of the way to the place and to the direction, and
  // drives S.kinematicsContacts(), whose Jacobian is S.jacobianContacts(), to zero.
  return S.getJointAngles();
}

std::vector<Eigen::VectorXd> taskSpaceMotion(Simulator& S, const std::string& peg,
                                             const Eigen::Vector3d& place, double margin, int T) {
  const int n = S.getJointDimension();
  const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(n, n);
  S.setContactMargin(margin);
  std::vector<Eigen::VectorXd> postures;
  // TODO: slide 2:42. At step t the peg should be at the interpolated place, pointing as at the start.
  return postures;
}

std::vector<Eigen::VectorXd> insertPeg(Simulator& S, const std::string& peg, const Eigen::Vector3d& inside,
                                       const Eigen::Vector3d& direction, double margin) {
  std::vector<Eigen::VectorXd> postures;
  // TODO: where should the peg be before it goes into the hole? Join the functions above.
  return postures;
}

Eigen::VectorXd priorityStep(const Eigen::MatrixXd& J1, const Eigen::VectorXd& dy1, const Eigen::MatrixXd& J2,
                             const Eigen::VectorXd& dy2) {
  // TODO: what does the first task demand? Which of the second's wishes is left then, and how does it
  // change with the motions that the first does not notice?
  return Eigen::VectorXd::Zero(J1.cols());
}

// From here on everything is given: the parts of the exercise one after another, with pictures. Change it as
// you like.

namespace {

const Eigen::Vector3d kTarget(-0.2, -0.4, 1.1);  // the centre of the circle, where the red ball is
const Eigen::Vector3d kHole(0, -1, 1), kDown(0, 0, -1);
constexpr double kMargin = 0.02;
// Of the arm: bent and away from the hole; and with the peg above it, but the elbow near the frame.
const Eigen::VectorXd kAbove =
    (Eigen::VectorXd(7) << 0.967552, -0.251879, -1.18846, 1.4825, 1.42033, 0.215273, -2.64193).finished();
const Eigen::VectorXd kStart = 0.6 * kAbove;

using Motion = std::vector<Eigen::VectorXd>;

Eigen::Vector3d onCircle(int t) {
  return kTarget + 0.2 * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
}

std::vector<Eigen::Vector3d> wholeCircle() {
  std::vector<Eigen::Vector3d> points;
  for (int t = 0; t <= 126; ++t) points.push_back(onCircle(t));
  return points;
}

// f(S, t) in each posture of a motion, t = 1, 2, ...; of one that is not there yet, where the robot starts.
template <class F>
std::vector<double> along(const std::string& scene, const Motion& motion, const F& f) {
  Simulator S(scene);
  S.setContactMargin(kMargin);
  std::vector<double> values;
  for (const Eigen::VectorXd& q : motion) {
    S.setJointAngles(q);
    values.push_back(f(S, static_cast<int>(values.size()) + 1));
  }
  if (motion.empty()) values.push_back(f(S, 1));
  return values;
}

// A logarithmic axis has no zero.
std::vector<double> positive(std::vector<double> values) {
  for (double& value : values) value = std::max(value, 1e-16);
  return values;
}

double errorOnCircle(const Simulator& S, int t) { return (S.kinematicsPos("handR") - onCircle(t)).norm(); }

// The circle of exercise 01, with no other task: nothing tells which posture to prefer.
Motion circleAlone(Simulator& S, int T) {
  const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(S.getJointDimension(), S.getJointDimension());
  Motion motion;
  for (int t = 1; t <= T; ++t) {
    const TaskTerm circle{S.kinematicsPos("handR") - onCircle(t), S.jacobianPos("handR"), 1e4};
    S.setJointAngles(S.getJointAngles() + multiTaskStep({circle}, W));
    motion.push_back(S.getJointAngles());
  }
  return motion;
}

void showNullspace() {
  const Simulator S("man.ors");
  const Eigen::MatrixXd J = S.jacobianPos("handR"), N = nullspaceProjector(J);
  const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(N.rows(), N.cols());
  print("joints that can move without the hand: trace of N", N.trace());
  print("largest entry of J N", (J * N).cwiseAbs().maxCoeff());
  for (const double precision : {1., 1e2, 1e4, 1e6})
    print("largest entry of I - J J#, less and less",
          (Eigen::Matrix3d::Identity() - J * regularisedInverse(J, W, precision)).cwiseAbs().maxCoeff());
}

void showCircles() {
  Simulator alone("man.ors"), tasks("man.ors"), film("man.ors");
  const Motion lost = circleAlone(alone, 2000);
  const Motion kept = circleWithTasks(tasks, "handR", kTarget, 0.2, "handL", 2000);
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
      .series = {
          {.label = "circle alone", .y = positive(along("man.ors", lost, errorOnCircle))},
          {.label = "with home and pointing tasks", .y = positive(along("man.ors", kept, errorOnCircle))}}};
  const Figure posture{
      .title = "How far the posture is from home",
      .xLabel = "step",
      .yLabel = "length of q [rad]",
      .legend = Legend::kTopLeft,
      .series = {{.label = "circle alone", .y = along("man.ors", lost, length)},
                 {.label = "with home and pointing tasks", .y = along("man.ors", kept, length)}}};
  const Figure pointing{.title = "How far the left hand is from pointing upwards",
                        .xLabel = "step",
                        .yLabel = "|z axis - up|",
                        .logY = true,
                        .series = {{.y = positive(along("man.ors", kept, tilt))}}};
  plot("circle", errors);
  plot("posture", posture);
  plot("pointing", pointing);
  alone.watch("circle_alone_after_2000_steps");
  tasks.watch("circle_with_tasks_after_2000_steps");
  circleWithTasks(film, "handR", kTarget, 0.2, "handL", 380);
  const PictureOptions look{.caption = "12.4.2: a circle, home, and the left hand up",
                            .traces = {"handR"},
                            .paths = {wholeCircle()}};
  writeVideo(film, "circle", look);
  writeReplay(film, "circle", look, {errors, posture, pointing});
}

double contactCost(const Simulator& S, int) {
  const Eigen::VectorXd cost = S.kinematicsContacts();
  return cost[0];
}

void showPeg() {
  Simulator S("pegInAHole.ors"), straight("pegInAHole.ors"), film("pegInAHole.ors");
  S.setJointAngles(kStart);
  film.clearRecording();
  film.setJointAngles(kStart);
  for (const Eigen::VectorXd& q : insertPeg(S, "peg", kHole, kDown, kMargin)) film.setJointAngles(q);
  print("peg", film.kinematicsPos("peg"));
  film.setContactMargin(kMargin);
  film.reportProxies();

  // From above the hole into it, in two ways. The contact cost rises where something comes too near.
  straight.setJointAngles(kAbove);
  const Motion inTaskSpace = taskSpaceMotion(straight, "peg", kHole, kMargin, 150);
  const Motion inJointSpace = jointSpaceMotion(kAbove, straight.getJointAngles(), 150);
  const auto beside = [](const Simulator& at, int) {
    return (at.kinematicsPos("peg") - kHole).head<2>().norm();
  };
  plot("interpolation",
       {.title = "From above the hole into it",
        .xLabel = "step",
        .yLabel = "distance of the peg from the middle line [m]",
        .series = {{.label = "joint space", .y = along("pegInAHole.ors", inJointSpace, beside)},
                   {.label = "task space", .y = along("pegInAHole.ors", inTaskSpace, beside)}}});
  const Figure cost{
      .title = "Coming too near",
      .xLabel = "step",
      .yLabel = "contact cost, margin 0.02 m",
      .series = {{.label = "joint space", .y = along("pegInAHole.ors", inJointSpace, contactCost)},
                 {.label = "task space", .y = along("pegInAHole.ors", inTaskSpace, contactCost)}}};
  plot("contacts", cost);
  const PictureOptions look{
      .caption = "The peg on its way into the hole", .traces = {"peg"}, .view = {1, -1, 0.7}};
  writeVideo(film, "peg", look);
  writeContactSheet(film, "peg_sheet", look);
  writeReplay(film, "peg", look, {cost});
}

// The hand shall circle; less important, it shall stay where it was, and its z axis shall point upwards.
struct TwoWishes {
  Eigen::MatrixXd J1;
  Eigen::VectorXd dy1;
  Eigen::MatrixXd J2;
  Eigen::VectorXd dy2;
};

TwoWishes wishesAt(const Simulator& S, const Eigen::Vector3d& start, int t) {
  TwoWishes wishes{S.jacobianPos("handR"), onCircle(t) - S.kinematicsPos("handR"),
                   Eigen::MatrixXd(6, S.getJointDimension()), Eigen::VectorXd(6)};
  wishes.J2 << S.jacobianPos("handR"), S.jacobianVec("handR");
  wishes.dy2 << start - S.kinematicsPos("handR"), Eigen::Vector3d::UnitZ() - S.kinematicsVec("handR");
  wishes.dy2 *= 0.1;  // a tenth of the wish at a time, so that the steps stay small
  return wishes;
}

// `step` gives dq from the wishes.
template <class Step>
Motion circleWithASecondWish(const Step& step) {
  Simulator S("man.ors");
  const Eigen::Vector3d start = S.kinematicsPos("handR");
  Motion motion;
  for (int t = 1; t <= 380; ++t) {
    S.setJointAngles(S.getJointAngles() + step(wishesAt(S, start, t)));
    motion.push_back(S.getJointAngles());
  }
  return motion;
}

void showPriority(const Motion& byLibrary) {
  const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(27, 27);
  const Motion weighted = circleWithASecondWish([&](const TwoWishes& wishes) {
    return multiTaskStep({TaskTerm{-wishes.dy1, wishes.J1, 1e4}, TaskTerm{-wishes.dy2, wishes.J2, 1e3}}, W);
  });
  const Motion strict = circleWithASecondWish(
      [](const TwoWishes& wishes) { return priorityStep(wishes.J1, wishes.dy1, wishes.J2, wishes.dy2); });
  const auto errors = [](const Motion& motion) { return positive(along("man.ors", motion, errorOnCircle)); };
  plot("priority", {.title = "A second wish that pulls the hand away",
                    .xLabel = "step",
                    .yLabel = "tracking error [m]",
                    .logY = true,
                    .series = {{.label = "weights 10 : 1", .y = errors(weighted)},
                               {.label = "strict priority", .y = errors(strict)},
                               {.label = "strict, library", .y = errors(byLibrary), .dashed = true}}});
}

}  // namespace

int main() {
  showNullspace();
  showCircles();
  showPeg();

  // Once your own step works, it lies on the library's.
  Simulator S("man.ors");
  const Eigen::Vector3d start = S.kinematicsPos("handR");
  Motion byLibrary;
  for (int t = 1; t <= 380; ++t) {
    const TwoWishes wishes = wishesAt(S, start, t);
    S.setJointAngles(S.getJointAngles() +
                     hierarchicalStep({{wishes.J1, wishes.dy1}, {wishes.J2, wishes.dy2}}));
    byLibrary.push_back(S.getJointAngles());
  }
  showPriority(byLibrary);
}

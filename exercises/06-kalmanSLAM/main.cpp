#include <algorithm>
#include <cmath>
#include <numbers>

#include "exercise.h"
#include "show.h"

using namespace rex;

Eigen::Vector3d stepped(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& u) {
  // TODO: slide 4:48, for a step of tau seconds.
  return x;
}

Eigen::MatrixXd stepByState(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& u) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(3, 3);
  // TODO: what does a slightly different heading change?
  return A;
}

Eigen::MatrixXd stepByControl(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& u) {
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(3, 2);
  // TODO: 12.9.2 a.
  return B;
}

Eigen::MatrixXd stepNoise(const CarSetup& car) {
  // TODO: the covariance of three independent numbers with that standard deviation.
  return Eigen::MatrixXd::Zero(3, 3);
}

Eigen::Vector2d view(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& l) {
  // TODO: l in the frame of the car; and if the car has the other sensor?
  return Eigen::Vector2d::Zero();
}

Eigen::MatrixXd viewByState(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& l) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(2, 3);
  // TODO: if the car moves, a landmark moves the other way; and if it turns?
  return C;
}

Eigen::MatrixXd viewByLandmark(const CarSetup& car, const Eigen::Vector3d& x, const Eigen::Vector2d& l) {
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(2, 2);
  // TODO: two columns of viewByState() are nearly this.
  return D;
}

Eigen::MatrixXd viewNoise(const CarSetup& car) {
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(2, 2);
  // TODO: of both sensors.
  return W;
}

Eigen::Vector2d viewGap(const CarSetup& car, const Eigen::Vector2d& y, const Eigen::Vector2d& expected) {
  Eigen::Vector2d gap = y - expected;
  // TODO: how far is it from a bearing of 3.1 to one of -3.1?
  return gap;
}

Belief predicted(const CarSetup& car, const Belief& belief, const Eigen::Vector2d& u) {
  // TODO: the third line of the derivation on 7:27, with f(s, u) in place of A s + a.
  return belief;
}

Belief corrected(const Belief& belief, const Eigen::VectorXd& gap, const Eigen::MatrixXd& C,
                 const Eigen::MatrixXd& W) {
  // TODO: the last lines of 7:27. What is K there, and what is y - C s - c here?
  return belief;
}

Belief tracked(const CarSetup& car, const Belief& belief, const Eigen::Vector2d& u,
               const Eigen::MatrixXd& landmarks, const Eigen::VectorXd& y) {
  // TODO: predict, stack the models of all landmarks, correct.
  return belief;
}

std::vector<Belief> hindsight(const CarSetup& car, const std::vector<Belief>& filtered,
                              const std::vector<Eigen::Vector2d>& controls) {
  std::vector<Belief> smooth = filtered;
  // TODO: from the end to the start. How are x(t) and x(t + 1) correlated before x(t + 1) is seen?
  return smooth;
}

Belief jointPredicted(const CarSetup& car, const Belief& joint, const Eigen::Vector2d& u) {
  Belief moved = joint;
  // TODO: what are f, A and Q of the whole state, in blocks?
  return moved;
}

Belief jointCorrected(const CarSetup& car, const Belief& joint, int i, const Eigen::Vector2d& y) {
  // TODO: which columns of the Jacobian of a sighting are not zero?
  return joint;
}

Belief withLandmark(const CarSetup& car, const Belief& joint, const Eigen::Vector2d& y) {
  const Eigen::Index n = joint.mean.size();
  Belief larger{Eigen::VectorXd::Zero(n + 2), Eigen::MatrixXd::Identity(n + 2, n + 2)};
  larger.mean.head(n) = joint.mean;
  larger.covariance.topLeftCorner(n, n) = joint.covariance;
  // TODO: l as a function of x and y, its two derivatives, and with them three blocks of the covariance.
  return larger;
}

std::vector<int> assigned(const CarSetup& car, const Belief& joint, const std::vector<Eigen::Vector2d>& ys) {
  std::vector<int> names(ys.size(), kUnclear);
  // TODO: how far is each y from what each landmark would look like, in terms of its covariance?
  return names;
}

std::vector<MapParticle> weighed(const CarSetup& car, const std::vector<MapParticle>& particles,
                                 const std::vector<LandmarkObservation>& sightings) {
  std::vector<MapParticle> after = particles;
  // TODO: for each landmark of each particle a filter of two numbers, and weights from what it expects.
  return after;
}

// What follows is given: the parts of the exercise one after another. show.cpp draws the pictures.
int main() {
  // Part 1: a landmark 3 m ahead and 1 m to the left, by both sensors; the derivatives; and 120 steps.
  const CarSetup car, polar{.rangeBearing = true};
  const Eigen::Vector3d x(2, 1, std::numbers::pi / 2);
  print("view, which should be 3 m ahead and 1 m to the left", view(car, x, {1, 4}));
  print("view, which should be 3.162 m away at 0.3217 rad", view(polar, x, {1, 4}));
  showDerivatives();
  const RecordedDrive drive =
      recordDrive(5, car, (Eigen::MatrixXd(2, 2) << 9, -6, 4, 16).finished(), 120, {0.5, 0.2}, 1e3);
  showSteps(car, drive);

  // Part 2: the same drive, with and without observations.
  const Belief start{Eigen::Vector3d::Zero(), 0.1 * Eigen::Matrix3d::Identity()};
  std::vector<Belief> run{start}, blind{start};
  for (std::size_t t = 0; t < drive.controls.size(); ++t) {
    run.push_back(tracked(car, run.back(), drive.controls[t], drive.landmarks, allSeen(drive, t)));
    blind.push_back(predicted(car, blind.back(), drive.controls[t]));
  }
  showTracking(drive, run, blind);
  showConsistency(start);

  // Part 3: what is known of it at its end.
  showSmoothing(drive, run, hindsight(car, run, drive.controls));

  // Part 4: 90 s among eight landmarks; the car sees those within 9 m.
  showMap(recordDrive(11, car, landmarksAround(8), 90, {1, 0.2}, 9));

  // Part 5: a map whose landmarks have no names, and a hundred maps.
  showNames(recordDrive(3, car, landmarksAround(7), 80, {1, 0.2}, 14));
  showParticles(recordDrive(4, car, landmarksAround(6), 45, {1, 0.2}, 12));
}

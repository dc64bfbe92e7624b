#include <algorithm>
#include <cmath>
#include <numbers>

#include "exercise.h"
#include "show.h"

using namespace rex;

// The rotation R and the position p as one matrix (2:11).
Eigen::Matrix4d transform(const Eigen::Matrix3d& R, const Eigen::Vector3d& p) {
  Eigen::Matrix4d X = Eigen::Matrix4d::Identity();
  X.topLeftCorner(3, 3) = R;
  X.topRightCorner(3, 1) = p;
  return X;
}

// [w]x, the matrix with [w]x v = w x v (2:9).
Eigen::Matrix3d skew(const Eigen::Vector3d& w) {
  Eigen::Matrix3d all;
  all << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
  return all;
}

Eigen::Matrix3d rotationMatrix(const Eigen::Vector3d& axis, double angle) {
  // TODO: Rodrigues' formula, slide 2:9. skew(axis) is above.
  return Eigen::Matrix3d::Zero();
}

Eigen::Vector3d rotationVector(const Eigen::Matrix3d& R) {
  // TODO: which entries of R contain the sine of the angle, which its cosine? What is left of the axis in
  // R - R^T, and in R + R^T, if the angle is nearly 0 or nearly pi?
  return Eigen::Vector3d::Zero();
}

Eigen::Vector4d composed(const Eigen::Vector4d& a, const Eigen::Vector4d& b) {
  // TODO: slide 2:10, but with the other order in the cross product.
  return Eigen::Vector4d::Zero();
}

Eigen::Vector4d between(const Eigen::Vector4d& a, const Eigen::Vector4d& b, double share) {
  // TODO: the arc between the two unit vectors in four dimensions. Which of b and -b is nearer to a?
  return Eigen::Vector4d::Zero();
}

Eigen::Matrix3d eulerMatrix(Convention convention, const Eigen::Vector3d& angles) {
  // TODO: three rotations about axes of the frame that has been turned already. In which order?
  return Eigen::Matrix3d::Zero();
}

Eigen::Vector3d eulerAngles(Convention convention, const Eigen::Matrix3d& R) {
  // TODO: multiply out the three rotations on paper. Which entries are a product of two factors only?
  return Eigen::Vector3d::Zero();
}

Eigen::Matrix3d turningAxes(Convention convention, const Eigen::Vector3d& angles) {
  // TODO: where in the world are the axes of the three rotations, after those before them?
  return Eigen::Matrix3d::Zero();
}

Eigen::Vector3d lostAxis(Convention convention, const Eigen::Vector3d& angles) {
  // TODO: two of the three axes coincide now. What is at right angles to the two that are left?
  return Eigen::Vector3d::Zero();
}

Eigen::Matrix4d inverted(const Eigen::Matrix4d& X_AB) {
  // TODO: solve p_A = R p_B + p for p_B. transform(R, p) is above.
  return Eigen::Matrix4d::Zero();
}

Eigen::Matrix4d seenFrom(const Eigen::Matrix4d& X_WA, const Eigen::Matrix4d& X_WB) {
  // TODO: X_AB X_BC = X_AC: neighbouring letters are equal and cancel.
  return Eigen::Matrix4d::Zero();
}

Eigen::Matrix4d jointMotion(const ChainJoint& joint, double q) {
  // TODO: slide 2:16, for any axis.
  return Eigen::Matrix4d::Zero();
}

Eigen::Matrix4d endPose(const Chain& chain, const Eigen::VectorXd& q) {
  // TODO: slide 2:15: from the world through all joints to the end.
  return Eigen::Matrix4d::Zero();
}

// A function of your own for what follows may be here: where the axis of each joint is in the world.

Eigen::MatrixXd pointJacobian(const Chain& chain, const Eigen::VectorXd& q, const Eigen::Vector3d& p_E) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, q.size());
  // TODO: column i is a x (p - p_i) if joint i is revolute. Where are a and p_i? And if it is prismatic?
  return J;
}

Eigen::MatrixXd vectorJacobian(const Chain& chain, const Eigen::VectorXd& q, const Eigen::Vector3d& v_E) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, q.size());
  // TODO: which joints turn a direction, and how?
  return J;
}

Eigen::MatrixXd differences(const VectorFunction& f, const Eigen::VectorXd& x) {
  Eigen::MatrixXd J(f(x).size(), x.size());
  // TODO: one column for each entry of x. The formula has an error, and rounding, too: which step
  // makes the larger of both small?
  J.setZero();
  return J;
}

Manipulability manipulability(const Eigen::MatrixXd& J) {
  // TODO: svd(J), or eigenvectors of J J^T. What do both say about the ellipsoid?
  return {Eigen::MatrixXd::Zero(J.rows(), J.rows()), Eigen::VectorXd::Zero(J.rows()), 0};
}

Eigen::Matrix4d screwMotion(const Screw& screw, double q) {
  // TODO: the rotation is that of Rodrigues. The position is the integral of R(t) v over t from 0 to q,
  // where R(t) is the rotation by t about w.
  return Eigen::Matrix4d::Zero();
}

std::vector<Screw> screwsOf(const Chain& chain) {
  std::vector<Screw> screws(chain.joints.size());
  // TODO: where is each axis if all coordinates are 0, and how fast does it move the origin of the world?
  return screws;
}

Eigen::Matrix4d endPoseByScrews(const std::vector<Screw>& screws, const Eigen::Matrix4d& X_WE0,
                                const Eigen::VectorXd& q) {
  Eigen::Matrix4d X = X_WE0;
  // TODO: which joint may move first, so that the axes of the others stay where they are?
  return X;
}

bool passesRotationTest(const RotationFunction& candidate) {
  // TODO: try several axes and angles. Which vectors do you know before and after the rotation?
  return true;
}

// What follows is given: the parts of the exercise one after another. show.cpp draws the pictures.
int main() {
  const double pi = std::numbers::pi;

  // Part 1: there and back, also by nearly half a turn; then a frame that turns by interpolation.
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 2) / 3;
  print("axis times angle, there and back", rotationVector(rotationMatrix(axis, 2)));
  print("the same near half a turn", rotationVector(rotationMatrix(axis, pi - 1e-9)));
  showTurns();

  // Part 2: where pitch is a quarter turn, the first and the third axis coincide.
  const Eigen::Vector3d locked(0.3, pi / 2, 0.8);
  print("the axes at gimbal lock", turningAxes(Convention::kYawPitchRoll, locked));
  print("the axis that is lost", lostAxis(Convention::kYawPitchRoll, locked));
  showLock();

  // Part 3: the end of a robot's chain, which should be where the simulator says.
  Simulator S("arm7.ors");
  S.setJointAngles(Eigen::VectorXd::LinSpaced(7, -0.5, 0.7));
  const Chain arm = chainOf(S, "arm7");  // chainOf: show.h
  const Eigen::VectorXd q = S.getJointAngles();
  print("endPose", endPose(arm, q));
  print("its position by the simulator", S.kinematicsPos("arm7"));

  // Part 4: the Jacobian by columns, by differences, and by the simulator; then the ellipsoid along a motion.
  const Eigen::Vector3d tip(0, 0, 0.2);
  print("pointJacobian", pointJacobian(arm, q, tip));
  const auto tipAt = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
    return (endPose(arm, at) * tip.homogeneous()).head<3>();
  };
  print("by differences", differences(tipAt, q));
  print("by the simulator", S.jacobianPos("arm7", tip));
  showEllipse();

  // Part 5, the bonus: the end pose once more.
  print("endPoseByScrews", endPoseByScrews(screwsOf(arm), endPose(arm, Eigen::VectorXd::Zero(7)), q));

  // Part 6, the bonus: does your test accept your own function, and one that turns by degrees?
  const auto byDegrees = [&](const Eigen::Vector3d& w, double angle) {
    return rotationMatrix(w, angle * 180 / pi);
  };
  print("rotationMatrix passes your test", passesRotationTest(rotationMatrix) ? "yes" : "no");
  print("a rotation by degrees passes it", passesRotationTest(byDegrees) ? "yes" : "no");
}

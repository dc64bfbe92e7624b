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
  // <solution rotationMatrix>
  const double c = std::cos(angle), s = std::sin(angle);
  return c * Eigen::Matrix3d::Identity() + s * skew(axis) + (1 - c) * axis * axis.transpose();
  // <todo>
  //| // TODO: Rodrigues' formula, slide 2:9. skew(axis) is above.
  //| return Eigen::Matrix3d::Zero();
  // </solution>
}

Eigen::Vector3d rotationVector(const Eigen::Matrix3d& R) {
  // <solution rotationVector>
  // R - R^T holds 2 sin(angle) [axis]x, and the trace 1 + 2 cos(angle).
  const Eigen::Vector3d twice(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  const double s = twice.norm() / 2, c = (R.trace() - 1) / 2, angle = std::atan2(s, c);
  if (c > 0) return twice / 2 * (s > 0 ? angle / s : 1);
  // Beyond a quarter turn: R + R^T holds (1 - cos(angle)) axis axis^T, which is exact where the sine
  // vanishes.
  const Eigen::Matrix3d square = (R + R.transpose()) / 2 - c * Eigen::Matrix3d::Identity();
  int largest = 0;
  square.diagonal().maxCoeff(&largest);
  const Eigen::Vector3d axis = square.col(largest).normalized();
  return axis.dot(twice) < 0 ? -angle * axis : angle * axis;
  // <todo>
  //| // TODO: which entries of R contain the sine of the angle, which its cosine? What is left of the axis in
  //| // R - R^T, and in R + R^T, if the angle is nearly 0 or nearly pi?
  //| return Eigen::Vector3d::Zero();
  // </solution>
}

Eigen::Vector4d composed(const Eigen::Vector4d& a, const Eigen::Vector4d& b) {
  // <solution composed>
  const Eigen::Vector3d u = a.tail<3>(), v = b.tail<3>();
  Eigen::Vector4d product;
  product << a[0] * b[0] - u.dot(v), a[0] * v + b[0] * u + u.cross(v);
  return product;
  // <todo>
  //| // TODO: slide 2:10, but with the other order in the cross product.
  //| return Eigen::Vector4d::Zero();
  // </solution>
}

Eigen::Vector4d between(const Eigen::Vector4d& a, const Eigen::Vector4d& b, double share) {
  // <solution between>
  // Quaternions are unit vectors in four dimensions: walk along the arc from a to the nearer of b and -b.
  const Eigen::Vector4d end = a.dot(b) < 0 ? Eigen::Vector4d(-b) : b;
  const double arc = std::atan2((end - a.dot(end) * a).norm(), a.dot(end));
  if (arc < 1e-9) return a;
  return (std::sin((1 - share) * arc) * a + std::sin(share * arc) * end) / std::sin(arc);
  // <todo>
  //| // TODO: the arc between the two unit vectors in four dimensions. Which of b and -b is nearer to a?
  //| return Eigen::Vector4d::Zero();
  // </solution>
}

Eigen::Matrix3d eulerMatrix(Convention convention, const Eigen::Vector3d& angles) {
  // <solution eulerMatrix>
  const auto about = [&](int axis, int angle) -> Eigen::Matrix3d {
    return rotationMatrix(Eigen::Vector3d::Unit(axis), angles[angle]);
  };
  if (convention == Convention::k313) return about(2, 0) * about(0, 1) * about(2, 2);
  return about(2, 0) * about(1, 1) * about(0, 2);
  // <todo>
  //| // TODO: three rotations about axes of the frame that has been turned already. In which order?
  //| return Eigen::Matrix3d::Zero();
  // </solution>
}

Eigen::Vector3d eulerAngles(Convention convention, const Eigen::Matrix3d& R) {
  // <solution eulerAngles>
  // The two entries of the last row or column that hold the sine or cosine of the second angle alone vanish
  // where it locks; then only a sum or a difference of the others is left, and the first one takes it all.
  if (convention == Convention::k313) {
    const double s = std::hypot(R(0, 2), R(1, 2));
    if (s < 1e-6) return {std::atan2(R(1, 0), R(0, 0)), std::atan2(s, R(2, 2)), 0};
    return {std::atan2(R(0, 2), -R(1, 2)), std::atan2(s, R(2, 2)), std::atan2(R(2, 0), R(2, 1))};
  }
  const double c = std::hypot(R(0, 0), R(1, 0));
  if (c < 1e-6) return {std::atan2(-R(0, 1), R(1, 1)), std::atan2(-R(2, 0), c), 0};
  return {std::atan2(R(1, 0), R(0, 0)), std::atan2(-R(2, 0), c), std::atan2(R(2, 1), R(2, 2))};
  // <todo>
  //| // TODO: multiply out the three rotations on paper. Which entries are a product of two factors only?
  //| return Eigen::Vector3d::Zero();
  // </solution>
}

Eigen::Matrix3d turningAxes(Convention convention, const Eigen::Vector3d& angles) {
  // <solution turningAxes>
  // A rotation leaves its own axis where it is: each axis is turned by the rotations before it.
  const bool zxz = convention == Convention::k313;
  Eigen::Matrix3d A;
  A << Eigen::Vector3d::UnitZ(), eulerMatrix(convention, {angles[0], 0, 0}).col(zxz ? 0 : 1),
      eulerMatrix(convention, angles).col(zxz ? 2 : 0);
  return A;
  // <todo>
  //| // TODO: where in the world are the axes of the three rotations, after those before them?
  //| return Eigen::Matrix3d::Zero();
  // </solution>
}

Eigen::Vector3d lostAxis(Convention convention, const Eigen::Vector3d& angles) {
  // <solution lostAxis>
  const Eigen::Matrix3d A = turningAxes(convention, angles);
  return Eigen::Vector3d(A.col(0)).cross(Eigen::Vector3d(A.col(1)));
  // <todo>
  //| // TODO: two of the three axes coincide now. What is at right angles to the two that are left?
  //| return Eigen::Vector3d::Zero();
  // </solution>
}

Eigen::Matrix4d inverted(const Eigen::Matrix4d& X_AB) {
  // <solution inverted>
  const Eigen::Matrix3d R_BA = X_AB.topLeftCorner(3, 3).transpose();
  return transform(R_BA, -R_BA * X_AB.topRightCorner(3, 1));
  // <todo>
  //| // TODO: solve p_A = R p_B + p for p_B. transform(R, p) is above.
  //| return Eigen::Matrix4d::Zero();
  // </solution>
}

Eigen::Matrix4d seenFrom(const Eigen::Matrix4d& X_WA, const Eigen::Matrix4d& X_WB) {
  // <solution seenFrom>
  return inverted(X_WA) * X_WB;
  // <todo>
  //| // TODO: X_AB X_BC = X_AC: neighbouring letters are equal and cancel.
  //| return Eigen::Matrix4d::Zero();
  // </solution>
}

Eigen::Matrix4d jointMotion(const ChainJoint& joint, double q) {
  // <solution jointMotion>
  if (joint.kind == JointKind::kPrismatic) return transform(Eigen::Matrix3d::Identity(), q * joint.axis);
  return transform(rotationMatrix(joint.axis, q), Eigen::Vector3d::Zero());
  // <todo>
  //| // TODO: slide 2:16, for any axis.
  //| return Eigen::Matrix4d::Zero();
  // </solution>
}

Eigen::Matrix4d endPose(const Chain& chain, const Eigen::VectorXd& q) {
  // <solution endPose>
  Eigen::Matrix4d X_WM = Eigen::Matrix4d::Identity();
  int i = 0;
  for (const ChainJoint& joint : chain.joints) X_WM = X_WM * joint.X_PJ * jointMotion(joint, q[i++]);
  return X_WM * chain.X_ME;
  // <todo>
  //| // TODO: slide 2:15: from the world through all joints to the end.
  //| return Eigen::Matrix4d::Zero();
  // </solution>
}

// <solution jointLines>
// The line of a joint in the world: its axis, and the origin of its frame.
struct JointLine {
  Eigen::Vector3d a, p;
  bool turns;
};

static std::vector<JointLine> jointLines(const Chain& chain, const Eigen::VectorXd& q) {
  std::vector<JointLine> lines;
  Chain part;  // up to the frame of each joint
  for (const ChainJoint& joint : chain.joints) {
    part.X_ME = joint.X_PJ;
    const Eigen::Matrix4d X_WJ = endPose(part, q);
    const bool turns = joint.kind == JointKind::kRevolute;
    lines.push_back({X_WJ.topLeftCorner(3, 3) * joint.axis, X_WJ.topRightCorner(3, 1), turns});
    part.joints.push_back(joint);
  }
  return lines;
}
// <todo>
//| // A function of your own for what follows may be here: where the axis of each joint is in the world.
// </solution>

Eigen::MatrixXd pointJacobian(const Chain& chain, const Eigen::VectorXd& q, const Eigen::Vector3d& p_E) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, q.size());
  // <solution pointJacobian>
  const Eigen::Vector3d p = (endPose(chain, q) * p_E.homogeneous()).head<3>();
  int i = 0;
  for (const auto& [a, at, turns] : jointLines(chain, q)) J.col(i++) = turns ? a.cross(p - at).eval() : a;
  // <todo>
  //| // TODO: column i is a x (p - p_i) if joint i is revolute. Where are a and p_i? And if it is prismatic?
  // </solution>
  return J;
}

Eigen::MatrixXd vectorJacobian(const Chain& chain, const Eigen::VectorXd& q, const Eigen::Vector3d& v_E) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, q.size());
  // <solution vectorJacobian>
  const Eigen::Vector3d v = endPose(chain, q).topLeftCorner(3, 3) * v_E;
  int i = 0;
  for (const auto& [a, at, turns] : jointLines(chain, q)) J.col(i++) = (turns ? 1 : 0) * a.cross(v);
  // <todo>
  //| // TODO: which joints turn a direction, and how?
  // </solution>
  return J;
}

Eigen::MatrixXd differences(const VectorFunction& f, const Eigen::VectorXd& x) {
  Eigen::MatrixXd J(f(x).size(), x.size());
  // <solution differences>
  // Central differences: an error of h^2 from the third derivative, and of 1e-16 / h from rounding.
  const double h = 1e-5;
  for (int i = 0; i < x.size(); ++i) {
    const Eigen::VectorXd move = h * Eigen::VectorXd::Unit(x.size(), i);
    J.col(i) = (f(x + move) - f(x - move)) / (2 * h);
  }
  // <todo>
  //| // TODO: one column for each entry of x. The formula has an error, and rounding, too: which step
  //| // makes the larger of both small?
  //| J.setZero();
  // </solution>
  return J;
}

Manipulability manipulability(const Eigen::MatrixXd& J) {
  // <solution manipulability>
  const SingularValues parts = svd(J);
  return {parts.U, parts.s, parts.s.prod()};
  // <todo>
  //| // TODO: svd(J), or eigenvectors of J J^T. What do both say about the ellipsoid?
  //| return {Eigen::MatrixXd::Zero(J.rows(), J.rows()), Eigen::VectorXd::Zero(J.rows()), 0};
  // </solution>
}

Eigen::Matrix4d screwMotion(const Screw& screw, double q) {
  // <solution screwMotion>
  if (screw.w.norm() < 1e-12) return transform(Eigen::Matrix3d::Identity(), q * screw.v);
  const Eigen::Matrix3d W = skew(screw.w);
  const Eigen::Matrix3d G =
      q * Eigen::Matrix3d::Identity() + (1 - std::cos(q)) * W + (q - std::sin(q)) * W * W;
  return transform(rotationMatrix(screw.w, q), G * screw.v);
  // <todo>
  //| // TODO: the rotation is that of Rodrigues. The position is the integral of R(t) v over t from 0 to q,
  //| // where R(t) is the rotation by t about w.
  //| return Eigen::Matrix4d::Zero();
  // </solution>
}

std::vector<Screw> screwsOf(const Chain& chain) {
  std::vector<Screw> screws(chain.joints.size());
  // <solution screwsOf>
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(static_cast<int>(screws.size()));
  auto screw = screws.begin();
  for (const auto& [a, p, turns] : jointLines(chain, zero))
    *screw++ = turns ? Screw{a, p.cross(a)} : Screw{0 * a, a};
  // <todo>
  //| // TODO: where is each axis if all coordinates are 0, and how fast does it move the origin of the world?
  // </solution>
  return screws;
}

Eigen::Matrix4d endPoseByScrews(const std::vector<Screw>& screws, const Eigen::Matrix4d& X_WE0,
                                const Eigen::VectorXd& q) {
  Eigen::Matrix4d X = X_WE0;
  // <solution endPoseByScrews>
  // The last joint moves first: its screw is then still where it was at zero.
  for (int i = static_cast<int>(screws.size()) - 1; i >= 0; --i)
    X = screwMotion(screws[static_cast<std::size_t>(i)], q[i]) * X;
  // <todo>
  //| // TODO: which joint may move first, so that the axes of the others stay where they are?
  // </solution>
  return X;
}

bool passesRotationTest(const RotationFunction& candidate) {
  // <solution passesRotationTest>
  // A rotation keeps its axis, and turns the two directions across it. Axes have entries of both signs;
  // angles include none, tiny ones and half a turn.
  const double pi = std::numbers::pi;
  std::vector<double> turns = {0, 1e-5, -1e-5, pi, -pi};
  for (double angle = -3; angle <= 3; angle += 0.25) turns.push_back(angle);
  for (const Eigen::Vector3d& w :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0, 0, 1),
        Eigen::Vector3d(Eigen::Vector3d(1, 2, -2) / 3), Eigen::Vector3d(Eigen::Vector3d(-2, 3, 6) / 7)}) {
    Eigen::Matrix3d frame;
    frame << w, w.unitOrthogonal(), w.cross(w.unitOrthogonal());
    for (const double angle : turns) {
      const double c = std::cos(angle), s = std::sin(angle);
      Eigen::Matrix3d turned;
      turned << frame.col(0), c * frame.col(1) + s * frame.col(2), c * frame.col(2) - s * frame.col(1);
      const double off = (candidate(w, angle) * frame - turned).norm();
      if (!(off < 1e-11)) return false;  // also if it is not a number
    }
  }
  return true;
  // <todo>
  //| // TODO: try several axes and angles. Which vectors do you know before and after the rotation?
  //| return true;
  // </solution>
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

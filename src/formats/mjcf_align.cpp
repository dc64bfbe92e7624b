#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "formats/mjcf_parts_internal.h"

namespace rex::mjcf {
namespace {

using Eigen::Matrix3d;

// Makes the axes of a rotation the principal ones of I, as MuJoCo does: by rotations of Jacobi from no turn
// at all, with the largest moment first. Other methods find other signs and orders.
Matrix3d principalAxes(const Matrix3d& I) {
  constexpr double kLeast = 1e-12;
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  Matrix3d D = I;
  for (int step = 0; step < 500; ++step) {
    const Matrix3d R = turn.toRotationMatrix();
    D = R.transpose() * I * R;
    int row = 1, column = 2;
    if (std::abs(D(0, 1)) > std::abs(D(0, 2)) && std::abs(D(0, 1)) > std::abs(D(1, 2)))
      row = 0, column = 1;
    else if (std::abs(D(0, 2)) > std::abs(D(1, 2)))
      row = 0;
    const double beside = D(row, column);
    if (std::abs(beside) < kLeast) break;
    const double ratio = (D(column, column) - D(row, row)) / (2 * beside);
    const double tangent = (ratio >= 0 ? 1 : -1) / (std::abs(ratio) + std::sqrt(1 + ratio * ratio));
    const double cosine = 1 / std::sqrt(1 + tangent * tangent);
    if (cosine > 1 - kLeast) break;
    const int axis = 3 - row - column;
    const double sine = (ratio >= 0 ? -1 : 1) * (axis == 1 ? -1 : 1) * std::sqrt((1 - cosine) / 2);
    Eigen::Quaterniond part(std::sqrt(1 - sine * sine), 0, 0, 0);
    part.vec()[axis] = sine;
    turn = (turn * part).normalized();
  }
  Eigen::Vector3d moments = D.diagonal();
  for (const int first : {0, 1, 0}) {
    if (!(moments[first] + kLeast < moments[first + 1])) continue;
    std::swap(moments[first], moments[first + 1]);
    Eigen::Quaterniond quarter(std::sqrt(0.5), 0, 0, 0);
    quarter.vec()[(first + 2) % 3] = std::sqrt(0.5);
    turn = (turn * quarter).normalized();
  }
  return turn.toRotationMatrix();
}

// The axes of the inertia: those that the file gives, those of the only geom, or the principal ones.
Matrix3d inertiaAxes(const BodyInFile& one, const BodySpec& body) {
  if (one.isWeighed && one.solids.size() == 1) {
    const Solid& solid = one.solids.front();
    const Matrix3d& R = solid.X_BS.R;
    return solid.mesh ? Matrix3d(R * principalAxes(R.transpose() * *body.inertia * R)) : R;
  }
  return !one.isWeighed && one.givenAxes ? *one.givenAxes : principalAxes(*body.inertia);
}

bool isPinned(const BodyTree& tree, const std::string& body) {
  return std::ranges::any_of(tree.spec.pins,
                             [&](const PinSpec& pin) { return pin.a == body || pin.b == body; });
}

}  // namespace

void alignFreeBodies(BodyTree& tree, Reading& reading) {
  for (const BodyInFile& one : tree.bodies) {
    BodySpec& body = tree.spec.bodies[one.body];
    const bool isLast = std::ranges::find(tree.bodies, body.name, &BodyInFile::parent) == tree.bodies.end();
    if (!one.aligns || !isLast || !(body.mass > 0)) continue;
    if (isPinned(tree, body.name)) {
      reading.forgive({.what = fmt::format("body '{}': align", body.name),
                       .where = body.where,
                       .found = "a <connect> or <weld> of the body",
                       .wanted = "none, for its points would move"},
                      "the body keeps its frame", Difference::kMotion);
      continue;
    }
    const Pose X_BI{inertiaAxes(one, body), body.p_BBcm};
    for (ShapeSpec& shape : body.shapes) shape.X_BS = X_BI.inverse() * shape.X_BS;
    body.p_BBcm.setZero();
    body.inertia = Matrix3d((X_BI.R.transpose() * *body.inertia * X_BI.R).diagonal().asDiagonal());
    JointSpec& joint = *std::ranges::find(tree.spec.joints, body.name, &JointSpec::child);
    const Pose X_WB = jointMotion(joint.type, joint.axis, joint.pitch, joint.q0.data());
    joint.q0 = joint.springReference = jointCoordinates(joint.type, joint.axis, X_WB * X_BI);
  }
}

}  // namespace rex::mjcf

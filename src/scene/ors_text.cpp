#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "geometry/rotation.h"
#include "scene/ors_text_internal.h"

namespace rex::ors {
namespace {

constexpr double kExact = 1e-15;

std::string joined(const Eigen::Ref<const Eigen::VectorXd>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + numberText(value);
  return text;
}

// The number without its last digits, if they are only rounding error.
double neat(double value) {
  const double rounded = std::round(value * 1e9) / 1e9;
  return std::abs(rounded - value) <= kExact ? rounded : value;
}

// R as a rotation about one coordinate axis, if it is one; in round degrees if they are exact enough.
std::optional<std::string> degreesText(const Eigen::Matrix3d& R) {
  constexpr double kDegree = std::numbers::pi / 180;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
    const double degrees = std::atan2(R(k, j), R(j, j)) / kDegree;
    for (const double candidate : {std::round(degrees * 1e6) / 1e6, degrees}) {
      const Eigen::Matrix3d turned = rotationAboutAxis(candidate * kDegree, axis);
      if ((turned - R).cwiseAbs().maxCoeff() <= kExact)
        return fmt::format("d({} {})", numberText(candidate), joined(axis));
    }
  }
  return std::nullopt;
}

// In round numbers if they are exact enough.
std::string quaternionText(const Eigen::Matrix3d& R) {
  const Quaternion q = quaternionFromRotation(R);
  const Quaternion rounded = (q * 1e6).array().round() / 1e6;
  const bool isExact = (rotationFromQuaternion(rounded) - R).cwiseAbs().maxCoeff() <= kExact;
  return fmt::format("q({})", joined(isExact ? rounded : q));
}

}  // namespace

std::string numberText(double value) {
  return value == 0 ? "0" : fmt::format("{}", value);  // not "-0"
}

std::string arrayText(const Eigen::Ref<const Eigen::VectorXd>& values) { return "[" + joined(values) + "]"; }

std::string poseText(const Pose& X) {
  std::string text = "<T";
  const Eigen::Vector3d p = X.p.unaryExpr(&neat);
  if (!p.isZero(0)) text += " t(" + joined(p) + ")";
  if (!isApprox({X.R, {0, 0, 0}}, Pose{}, kExact))
    text += " " + degreesText(X.R).value_or(quaternionText(X.R));
  return text + ">";
}

}  // namespace rex::ors

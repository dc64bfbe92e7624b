#include "cli/robot/view_option.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/lower_case.h"
#include "base/text.h"

namespace rex::cli {
namespace {

using Eigen::Vector3d;

struct KnownView {
  const char* name;
  Vector3d direction;
};

// For a robot that faces -y. Slightly from above, as one looks at a robot.
const std::array<KnownView, 5> kViews = {{{"front", {0, -1, 0.25}},
                                          {"back", {0, 1, 0.25}},
                                          {"left", {1, 0, 0.25}},
                                          {"right", {-1, 0, 0.25}},
                                          {"top", {0, 0, 1}}}};

// A quarter turn takes a robot that faces -y to one that faces +x.
Vector3d turned(const Vector3d& v, Facing facing) {
  return facing == Facing::kMinusY ? v : Vector3d(-v.y(), v.x(), v.z());
}

// The axis nearest to a direction, such as "+x".
std::string axisOf(const Vector3d& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return fmt::format("{}{}", direction[axis] < 0 ? '-' : '+', "xyz"[axis]);
}

std::optional<Vector3d> pointIn(std::string_view text) {
  const std::vector<std::string_view> fields = splitAt(text, ',');
  if (fields.size() != 3) return {};
  Vector3d point;
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> number = parseNumber<double>(fields[static_cast<std::size_t>(i)]);
    if (!number) return {};
    point[i] = *number;
  }
  return point;
}

}  // namespace

Facing facingOf(const std::filesystem::path& file) {
  return endingOf(file) == ".ors" ? Facing::kMinusY : Facing::kPlusX;
}

View::View(const std::string& text, Facing facing) : label_(text) {
  if (text == "default") return;
  std::vector<std::string> names = {"default"};
  for (const KnownView& view : kViews) {
    names.emplace_back(view.name);
    if (text == view.name) {
      direction_ = turned(view.direction, facing);
      label_ = fmt::format("{} (from {})", text, axisOf(direction_));
      return;
    }
  }
  const std::size_t at = text.find('@');
  const auto first = pointIn(text.substr(0, at));
  if (first && at == std::string::npos && first->norm() > 0) {
    direction_ = *first;
    return;
  }
  const auto second = at == std::string::npos ? std::nullopt : pointIn(text.substr(at + 1));
  if (!first || !second || *first == *second)
    throw UsageError({.what = "--camera",
                      .found = "'" + text + "'",
                      .wanted = "default, front, back, left, right, top, a direction x,y,z, or eye and "
                                "target x,y,z@x,y,z",
                      .nearest = nearestNames(text, names)});
  hasEye_ = true;
  eye_ = *first;
  target_ = *second;
  direction_ = eye_ - target_;
}

Camera View::camera(const Bounds& bounds, double aspect) const {
  return hasEye_ ? lookAt(eye_, target_) : framing(bounds, direction_, aspect);
}

}  // namespace rex::cli

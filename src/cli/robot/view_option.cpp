#include "cli/robot/view_option.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace rex::cli {
namespace {

using Eigen::Vector3d;

struct KnownView {
  const char* name;
  Vector3d direction;
};

// Slightly from above, as one looks at a robot.
const std::array<KnownView, 6> kViews = {{{"default", kDefaultView},
                                          {"front", {0, -1, 0.25}},
                                          {"back", {0, 1, 0.25}},
                                          {"left", {1, 0, 0.25}},
                                          {"right", {-1, 0, 0.25}},
                                          {"top", {0, 0, 1}}}};

std::optional<Vector3d> pointIn(std::string_view text) {
  Vector3d point;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (int i = 0; i < 3; ++i) {
    const auto [next, problem] = std::from_chars(at, end, point[i]);
    if (problem != std::errc()) return {};
    at = next;
    if (i < 2 && (at == end || *at++ != ',')) return {};
  }
  if (at != end || !point.allFinite()) return {};
  return point;
}

}  // namespace

View::View(const std::string& text) {
  std::vector<std::string> names;
  for (const KnownView& view : kViews) {
    names.emplace_back(view.name);
    if (text == view.name) {
      direction_ = view.direction;
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

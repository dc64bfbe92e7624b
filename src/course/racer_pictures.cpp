#include "course/racer_pictures.h"

#include <numbers>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

constexpr double kLane = 0.3;  // metres from racer to racer
constexpr Color kTireColor{0.20f, 0.22f, 0.26f}, kCrossColor{0.93f, 0.93f, 0.93f},
    kRodColor{0.55f, 0.57f, 0.60f};
// Told apart with any colour vision.
constexpr Color kBodyColors[] = {
    {0.0f, 0.45f, 0.7f}, {0.84f, 0.37f, 0.0f}, {0.0f, 0.62f, 0.45f}, {0.80f, 0.47f, 0.65f}};

void requireView(const RacerView& view) {
  if (view.x.cols() == 0)
    throw Error({.what = "picture of racers", .found = "none", .wanted = "at least one"});
  requireFinite("racer: state", view.x.reshaped());
  if (!view.names.empty() && static_cast<Eigen::Index>(view.names.size()) != view.x.cols())
    throw Error({.what = "picture of racers",
                 .found = fmt::format("{} names", view.names.size()),
                 .wanted = fmt::format("{}, or none", view.x.cols())});
}

// The pose of (x, z, angle) in the plane y = lane.
Pose poseInLane(const Eigen::Vector3d& at, double lane) {
  return translation(at[0], lane, at[1]) * rotation(at[2], Eigen::Vector3d::UnitY());
}

void addWheel(Picture& picture, const Pose& X_WA, double r) {
  const double width = 0.8 * r;
  const Pose lying = rotation(std::numbers::pi / 2, Eigen::Vector3d::UnitX());  // its axis along y
  const Shape tire{.type = ShapeType::kCylinder, .extent = {0, 0, width}, .radius = r};
  picture.solids.push_back({tire, X_WA * lying, kTireColor, "wheel"});
  for (const Eigen::Vector3d& bar :
       {Eigen::Vector3d(1.7 * r, 1.04 * width, 0.2 * r), {0.2 * r, 1.02 * width, 1.7 * r}})
    picture.solids.push_back({{.extent = bar}, X_WA, kCrossColor, "cross"});
}

// Its block is centred where its mass is.
void addPendulum(Picture& picture, const Pose& X_WB, double l, const Color& color) {
  const Shape rod{.type = ShapeType::kCylinder, .extent = {0, 0, l}, .radius = 0.016 * l};
  const Shape block{
      .type = ShapeType::kRoundedBox, .extent = l * Eigen::Vector3d(0.14, 0.2, 0.6), .radius = 0.03 * l};
  picture.solids.push_back({rod, X_WB * translation(0, 0, -l / 2), kRodColor, "rod"});
  picture.solids.push_back({block, X_WB, color, "pendulum"});
}

}  // namespace

Picture racerPicture(const RacerView& view) {
  requireView(view);
  Picture picture;
  picture.ground.cell = 0.1;
  for (Eigen::Index k = 0; k < view.x.cols(); ++k) {
    const Eigen::Matrix<double, 3, 2> poses = view.dynamics.poses(view.x.col(k).head<2>());
    const double lane = kLane * static_cast<double>(k), l = view.dynamics.l;
    const Pose X_WB = poseInLane(poses.col(1), lane);
    const Color& color = kBodyColors[static_cast<std::size_t>(k) % std::size(kBodyColors)];
    addWheel(picture, poseInLane(poses.col(0), lane), view.dynamics.r);
    addPendulum(picture, X_WB, l, color);
    if (!view.names.empty()) {  // each higher than the one in front, beside whose name it would be
      const double above = l * (0.4 + 0.2 * static_cast<double>(k));
      picture.labels.push_back(
          {view.names[static_cast<std::size_t>(k)], X_WB * Eigen::Vector3d(0, 0, above), color});
    }
  }
  if (!view.caption.empty()) picture.captions.push_back({.text = view.caption});
  return picture;
}

}  // namespace rex

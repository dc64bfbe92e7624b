#include "course/car_pictures.h"

#include <algorithm>
#include <cmath>

#include "course/car_view_internal.h"
#include "course/film.h"
#include "render/picture.h"

namespace rex {
namespace {

using internal::kCarLength, internal::kCarMiddle, internal::kCarWidth, internal::placeAt;

// Heights of flat marks above the ground, metres.
constexpr double kEllipseHeight = 0.04, kPathHeight = 0.07, kDotHeight = 0.12;
// Marks of a car's pose lie above its body, which would hide them.
constexpr double kPoseHeight = 0.57;
constexpr double kPostHeight = 1;

Color faded(Color color, double opacity) {
  color.a = static_cast<float>(opacity);
  return color;
}

Eigen::Vector3d lifted(const Eigen::Vector2d& place, double height) { return {place.x(), place.y(), height}; }

std::vector<Eigen::Vector3d> allLifted(const Eigen::Matrix2Xd& places, double height) {
  std::vector<Eigen::Vector3d> points;
  for (const auto& place : places.colwise()) points.push_back(lifted(place, height));
  return points;
}

void addCar(Picture& picture, const Eigen::Vector3d& pose, double scale, const char* name, const Color& body,
            const Color& cabin) {
  const Pose X_WR = translation(pose.x(), pose.y(), 0) * rotation(pose.z(), Eigen::Vector3d::UnitZ());
  const Shape box{.extent = scale * Eigen::Vector3d(kCarLength, kCarWidth, 0.5)},
      roof{.extent = scale * Eigen::Vector3d(1.3, 1.25, 0.4)};
  const double middle = scale * kCarMiddle;
  picture.solids.push_back({box, X_WR * translation(middle, 0, scale * 0.3), body, name});
  picture.solids.push_back({roof, X_WR * translation(middle, 0, scale * 0.75), cabin, name});
}

void addOutline(Picture& picture, const Eigen::Vector3d& pose, double scale) {
  constexpr double kHeight = 0.55, kLeft = kCarWidth / 2;
  constexpr double kBack = kCarMiddle - kCarLength / 2, kFront = kCarMiddle + kCarLength / 2;
  Polyline line{.color = kEstimateColor, .width = 2};
  for (const auto& [ahead, left] :
       {std::pair{kBack, -kLeft}, {kFront, -kLeft}, {kFront, kLeft}, {kBack, kLeft}, {kBack, -kLeft}})
    line.points.push_back(lifted(placeAt(pose, scale * ahead, scale * left), scale * kHeight));
  picture.polylines.push_back(std::move(line));
}

void addLandmarks(Picture& picture, const Eigen::Matrix2Xd& landmarks) {
  const Shape post{.type = ShapeType::kCylinder, .extent = {0, 0, kPostHeight}, .radius = 0.1};
  for (const auto& place : landmarks.colwise())
    picture.solids.push_back(
        {post, translation(place.x(), place.y(), kPostHeight / 2), kLandmarkColor, "landmark"});
  // From a distance a post is too thin to see.
  if (landmarks.cols() > 0)
    picture.pointSets.push_back({allLifted(landmarks, kPostHeight), kLandmarkColor, 8});
}

void addParticles(Picture& picture, const CarView& view) {
  const double stroke = 0.9 * view.carScale;  // metres
  for (const internal::ParticleGroup& group : internal::particleGroups(view)) {
    PointSet dots{.color = faded(kEstimateColor, group.strength), .size = 3};
    LineSet strokes{.color = faded(kEstimateColor, 0.4 * group.strength), .width = 1};
    for (const Eigen::Vector3d& pose : group.poses) {
      dots.points.push_back(lifted(pose.head<2>(), kPoseHeight));
      strokes.segments.emplace_back(dots.points.back(), lifted(placeAt(pose, stroke, 0), kPoseHeight));
    }
    picture.lineSets.push_back(std::move(strokes));
    picture.pointSets.push_back(std::move(dots));
  }
}

void addBeliefs(Picture& picture, const std::vector<PlanarGaussian>& beliefs, double sigmas,
                const Color& color, double height) {
  if (beliefs.empty()) return;
  LineSet outlines{.color = color, .width = 1.5};
  PointSet means{.color = color, .size = 5};
  for (const PlanarGaussian& belief : beliefs) {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    covariance.topLeftCorner<2, 2>() = belief.covariance;
    picture.ellipsoids.push_back(
        covarianceEllipsoid(lifted(belief.mean, height), covariance, sigmas, faded(color, 0.25)));
    means.points.push_back(lifted(belief.mean, height));
    const auto corners = allLifted(internal::outlineOf(belief, sigmas), height);
    for (std::size_t i = 1; i < corners.size(); ++i)
      outlines.segments.emplace_back(corners[i - 1], corners[i]);
  }
  picture.lineSets.push_back(std::move(outlines));
  picture.pointSets.push_back(std::move(means));
}

void addSightings(Picture& picture, const CarView& view) {
  if (view.sightings.cols() == 0) return;
  const Eigen::Vector3d& from = view.car ? *view.car : *view.estimate;
  LineSet lines{.color = faded(kLandmarkColor, 0.7), .width = 1};
  for (const auto& place : view.sightings.colwise())
    lines.segments.emplace_back(lifted(from.head<2>(), 0.5), lifted(place, kPostHeight / 2));
  picture.lineSets.push_back(std::move(lines));
}

void addPaths(Picture& picture, const std::vector<DrawnPath>& paths) {
  for (const DrawnPath& path : paths) {
    if (path.points.cols() > 1)
      picture.polylines.push_back({allLifted(path.points, kPathHeight), path.color, path.width});
    if (!path.name.empty()) picture.captions.push_back({.text = path.name, .color = path.color});
  }
}

// What the camera must see. Large ellipses count only up to a limit: a very uncertain belief would dwarf the
// rest.
void include(Bounds& bounds, const CarView& view) {
  const auto square = [&](const Eigen::Vector2d& middle, double reach) {
    bounds.include({middle.x() - reach, middle.y() - reach, 0});
    bounds.include({middle.x() + reach, middle.y() + reach, kPostHeight});
  };
  const auto all = [&](const auto& places) {
    for (const auto& place : places.colwise()) square(place.template head<2>(), 0.5);
  };
  for (const auto& car : {view.car, view.estimate})
    if (car) square(car->head<2>(), view.carScale * (kCarMiddle + kCarLength / 2));
  if (view.map) {
    const Eigen::Matrix2d corners = internal::cornersOf(*view.map);
    for (const auto& corner : corners.colwise()) square(corner, 0);
  }
  all(view.landmarks), all(view.particles), all(view.sightings), all(view.scan);
  for (const DrawnPath& path : view.paths) all(path.points);
  constexpr double kReach = 5;
  for (const auto* beliefs : {&view.poseBeliefs, &view.landmarkBeliefs})
    for (const PlanarGaussian& belief : *beliefs)
      square(belief.mean, std::min(kReach, view.sigmas * std::sqrt(belief.covariance.trace())));
}

}  // namespace

Picture carPicture(const CarView& view) {
  requireDrawable(view);
  Picture picture;
  picture.ground.cell = 5;
  if (!view.caption.empty()) picture.captions.push_back({.text = view.caption});
  if (view.map) picture.solids = internal::wallSolids(*view.map);
  if (view.car)
    addCar(picture, *view.car, view.carScale, "car", {0.32f, 0.35f, 0.41f}, {0.80f, 0.82f, 0.86f});
  addLandmarks(picture, view.landmarks);
  if (view.scan.cols() > 0) picture.pointSets.push_back({allLifted(view.scan, kDotHeight), kScanColor, 3});
  addBeliefs(picture, view.landmarkBeliefs, view.sigmas, kLandmarkColor, kEllipseHeight);
  addBeliefs(picture, view.poseBeliefs, view.sigmas, kEstimateColor, kPoseHeight);
  addPaths(picture, view.paths);
  addParticles(picture, view);
  addSightings(picture, view);
  if (view.estimate) {
    addCar(picture, *view.estimate, view.carScale, "estimate", faded(kEstimateColor, 0.45),
           faded(kEstimateColor, 0.45));
    addOutline(picture, *view.estimate, view.carScale);
  }
  return picture;
}

Film carFilm(const std::vector<CarView>& views, double step) {
  Bounds scene;
  for (const CarView& view : views) include(scene, view);
  return makeFilm(static_cast<int>(views.size()), step, [&](int i) {
    Picture picture = carPicture(views[static_cast<std::size_t>(i)]);
    picture.ground.scene = scene;
    return picture;
  });
}

}  // namespace rex

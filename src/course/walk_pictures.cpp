#include "course/walk_pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/folders.h"
#include "base/require.h"
#include "course/film.h"
#include "formats/scene_file.h"
#include "locomotion/walking_pattern.h"

namespace rex {
namespace {

// Told apart with any colour vision.
constexpr Color kBlue{0.0f, 0.45f, 0.7f}, kOrange{0.84f, 0.37f, 0.0f};
constexpr Color kSlopeColor{0.75f, 0.77f, 0.8f}, kHipColor{0.35f, 0.37f, 0.42f},
    kFootprintColor{0.7f, 0.72f, 0.76f};

void requireWalk(const CompassWalk& walk, int view) {
  if (view < 0 || view >= static_cast<int>(walk.views.size()))
    throw Error({.what = "picture of a compass walker",
                 .found = fmt::format("view {}", view),
                 .wanted = fmt::format("one of {}, counted from 0", walk.views.size())});
  for (const CompassView& at : walk.views) {
    requireFinite("compass walker: state", at.x);
    requireFinite("compass walker: path of the foot", at.foot);
  }
}

// A leg hangs from the hip and is turned by its angle.
void addLeg(Picture& picture, const CompassGait& walker, const Eigen::Vector3d& hip, double angle,
            const Color& color) {
  const double l = walker.a + walker.b, thick = 0.02 * l;
  const Pose X_WL = translation(hip.x(), hip.y(), hip.z()) * rotation(-angle, Eigen::Vector3d::UnitY());
  const Shape leg{.type = ShapeType::kCapsule, .extent = {0, 0, l - 2 * thick}, .radius = thick};
  picture.solids.push_back({leg, X_WL * translation(0, 0, -l / 2), color, "leg"});
  picture.solids.push_back({{.type = ShapeType::kSphere, .radius = 2.5 * thick},
                            X_WL * translation(0, 0, -walker.b),
                            color,
                            "leg mass"});
}

// A slope from behind the first foot to beyond the last one.
void addSlope(Picture& picture, const CompassWalk& walk) {
  const double l = walk.walker.a + walk.walker.b;
  double first = 0, last = 0;
  for (const CompassView& at : walk.views) {
    first = std::min(first, at.foot);
    last = std::max(last, at.foot);
  }
  const Eigen::Vector3d extent(last - first + 2 * l, 0.5 * l, 0.05 * l);
  picture.solids.push_back({{.extent = extent},
                            rotation(walk.walker.slope, Eigen::Vector3d::UnitY()) *
                                translation((first + last) / 2, 0, -extent.z() / 2),
                            kSlopeColor,
                            "slope"});
}

void addFootprints(Picture& picture, const WalkPlan& plan) {
  for (const Footstep& foot : plan.footsteps)
    picture.solids.push_back(
        {{.extent = {plan.sole.length, plan.sole.width, 0.002}},
         translation(foot.p.x(), foot.p.y(), 0.001) * rotation(foot.yaw, Eigen::Vector3d::UnitZ()),
         kFootprintColor,
         "footprint"});
}

// Up to and including this step, just above the footprints; where the paths cross, the centre of mass is on
// top.
void addWays(Picture& picture, const HumanoidWalk& walk, std::size_t step) {
  Polyline center{.color = kBlue}, zmp{.color = kOrange};
  for (std::size_t i = 0; i <= step; ++i) {
    zmp.points.emplace_back(walk.zmp[i].x(), walk.zmp[i].y(), 0.004);
    center.points.emplace_back(walk.center[i].x(), walk.center[i].y(), 0.008);
  }
  picture.pointSets.push_back({.points = {zmp.points.back()}, .color = kOrange, .size = 9});
  if (step > 0) picture.polylines = {zmp, center};
}

void requireWays(const HumanoidWalk& walk, Eigen::Index steps) {
  for (const auto* way : {&walk.center, &walk.zmp}) {
    if (static_cast<Eigen::Index>(way->size()) != steps)
      throw Error({.what = "film of a humanoid",
                   .found = fmt::format("a path of {} steps", way->size()),
                   .wanted = fmt::format("{}, as the walk has", steps)});
    for (const Eigen::Vector2d& p : *way) requireFinite("film of a humanoid: path", p);
  }
}

}  // namespace

CourseHumanoid courseHumanoid(const std::vector<ShapeSpec>& floor) {
  SceneSpec scene = readScene(homeFolder() / "data/robots/humanoid/humanoid.urdf",
                              {.allowMissingMeshes = true, .freeBase = true})
                        .spec;
  scene.worldShapes.insert(scene.worldShapes.end(), floor.begin(), floor.end());
  Model model = compile(scene);
  Eigen::VectorXd start = model.initialPositions();
  for (const Joint& joint : model.joints()) {
    if (joint.name.ends_with("_hip_pitch") || joint.name.ends_with("_ankle_pitch"))
      start[joint.qIndex] = -0.35;
    if (joint.name.ends_with("_knee")) start[joint.qIndex] = 0.7;
    if (joint.type == JointType::kFree) start.segment<3>(joint.qIndex) = Eigen::Vector3d(0, 0, 0.84);
  }
  const Legs legs{.leftFoot = model.body("left_foot"),
                  .rightFoot = model.body("right_foot"),
                  .trunk = model.body("pelvis"),
                  .p_FS = {0.03, 0, -0.075}};
  return {std::move(model), legs, std::move(start)};
}

Figure footprintFigure(const WalkPlan& plan) {
  static_cast<void>(duration(plan));  // throws if the plan is not valid
  Figure figure = planeFigure({});
  for (const Footstep& foot : plan.footsteps) {
    const Eigen::Vector2d along(std::cos(foot.yaw), std::sin(foot.yaw)), left(-along.y(), along.x());
    Region sole;
    for (const Eigen::Vector2d& corner :
         {Eigen::Vector2d(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
      const Eigen::Vector2d p =
          foot.p + corner.x() * plan.sole.length * along + corner.y() * plan.sole.width * left;
      sole.add(p.x(), p.y());
    }
    figure.regions.push_back(sole);
  }
  return figure;
}

Picture compassPicture(const CompassWalk& walk, int view) {
  requireWalk(walk, view);
  Picture picture;
  addSlope(picture, walk);
  const CompassGait& walker = walk.walker;
  const CompassView& at = walk.views[static_cast<std::size_t>(view)];
  const double l = walker.a + walker.b;
  const Eigen::Vector3d hip(at.foot * std::cos(walker.slope) - l * std::sin(at.x[0]), 0,
                            -at.foot * std::sin(walker.slope) + l * std::cos(at.x[0]));
  const Eigen::Vector3d aside(0, 0.08 * l, 0);
  addLeg(picture, walker, hip + aside, at.x[at.leftStands ? 0 : 1], kBlue);
  addLeg(picture, walker, hip - aside, at.x[at.leftStands ? 1 : 0], kOrange);
  picture.solids.push_back({{.type = ShapeType::kSphere, .radius = 0.08 * l},
                            translation(hip.x(), hip.y(), hip.z()),
                            kHipColor,
                            "hip"});
  picture.ground.cell = 0.25 * l;
  picture.ground.height = bounds(picture.solids.front()).low.z();  // below the slope
  return picture;
}

Film compassFilm(const CompassWalk& walk, double step) {
  return makeFilm(static_cast<int>(walk.views.size()), step,
                  [&](int view) { return compassPicture(walk, view); });
}

Film humanoidFilm(const HumanoidWalk& walk) {
  const CourseHumanoid humanoid = courseHumanoid();
  const WalkingPattern pattern =
      walkingPattern(humanoid.model, humanoid.legs, walk.plan, humanoid.start, {.preview = walk.preview});
  if (pattern.status != WalkingPattern::Status::kWalks)
    throw Error({.what = "film of a humanoid",
                 .found = pattern.message,
                 .wanted = "a walk that the robot can perform"});
  requireWays(walk, pattern.Q.cols());
  return makeFilm(static_cast<int>(pattern.Q.cols()), walk.preview.step, [&](int step) {
    Picture picture = scenePicture(humanoid.model, forwardKinematics(humanoid.model, pattern.Q.col(step)));
    addFootprints(picture, walk.plan);
    addWays(picture, walk, static_cast<std::size_t>(step));
    return picture;
  });
}

}  // namespace rex

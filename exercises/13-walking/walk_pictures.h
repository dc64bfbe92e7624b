#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "course/film_files.h"
#include "exercise.h"
#include "locomotion/footsteps.h"
#include "render/scene_picture.h"
#include "scene/scene_file.h"
#include "scene/state.h"
#include "swing.h"

// How main() draws and films what walks.

inline const rex::Color kBlue{0.0f, 0.45f, 0.7f}, kOrange{0.84f, 0.37f, 0.0f}, kSoft{0.62f, 0.66f, 0.72f},
    kBlack{0, 0, 0}, kGreen{0.0f, 0.6f, 0.45f};

/// Points seen from above, or any two numbers over one another.
using Points = std::vector<Eigen::Vector2d>;

inline rex::Series wayOf(const std::string& label, const Points& points, const rex::Color& color,
                         double size = 1) {
  rex::Series series{.label = label, .size = size, .color = color};
  for (const Eigen::Vector2d& p : points) {
    series.x.push_back(p[0]);
    series.y.push_back(p[1]);
  }
  return series;
}

/// Closed around its corners.
inline rex::Series outlineOf(const std::string& label, Points corners, const rex::Color& color,
                             double size = 1) {
  corners.push_back(corners.front());
  return wayOf(label, corners, color, size);
}

/// The four corners of a sole.
inline Points soleOf(const rex::Footstep& foot, const rex::Sole& sole) {
  const double c = std::cos(foot.yaw), s = std::sin(foot.yaw);
  Points corners;
  for (const auto& [along, left] : {std::pair{-.5, -.5}, {.5, -.5}, {.5, .5}, {-.5, .5}}) {
    const double x = along * sole.length, y = left * sole.width;
    corners.emplace_back(foot.p[0] + c * x - s * y, foot.p[1] + s * x + c * y);
  }
  return corners;
}

/// The walk of main(): a few steps ahead, then around a bend.
inline rex::WalkPlan walkAround() {
  rex::WalkPlan plan;
  double x = 0, y = 0;
  int i = 0;
  for (const double yaw : {0., 0., 0., 0., 0., .15, .3, .45, .6, .6}) {
    const bool isLeft = i % 2 == 0;
    const double c = std::cos(yaw), s = std::sin(yaw), beside = isLeft ? .095 : -.095;
    if (i > 1 && i < 9) x += .2 * c, y += .2 * s;
    plan.footsteps.push_back({.side = isLeft ? rex::Side::kLeft : rex::Side::kRight,
                              .p = {x - s * beside, y + c * beside},
                              .yaw = yaw});
    ++i;
  }
  return plan;
}

inline rex::Figure footprints(const std::string& title, const rex::WalkPlan& plan) {
  rex::Figure figure{.title = title,
                     .xLabel = "x [m]",
                     .yLabel = "y [m]",
                     .equalAxes = true,
                     .legend = rex::Legend::kTopLeft,
                     .width = 1000,
                     .height = 480};
  for (const rex::Footstep& foot : plan.footsteps) {
    const rex::Series corners = wayOf("", soleOf(foot, plan.sole), kSoft);
    figure.regions.push_back({.x = corners.x, .y = corners.y});
  }
  return figure;
}

// Films.

inline void writeBoth(rex::Film film, const std::string& name, const Eigen::Vector3d& view, int width,
                      int height) {
  rex::settleGround(film);
  const rex::Shot shot{rex::framing(film, view, static_cast<double>(width) / height), width, height};
  rex::writeFilmVideo(film, shot, name, 30);
  rex::writeFilmSheet(film, shot, name + "_sheet.png", 6);
}

/// A motion of a walker: its states, 30 in a second, and how far down the slope the foot is that stands.
struct WalkerMotion {
  std::vector<Eigen::Vector4d> states;
  std::vector<double> feet;
  std::vector<bool> leftStands;
};

inline rex::Picture pictureOf(const Walker& walker, const WalkerMotion& motion, std::size_t i) {
  rex::Picture picture;
  const double l = walker.a + walker.b, thick = .02 * l, end = motion.feet.back() + l;
  const rex::Pose slope = rex::rotation(walker.slope, Eigen::Vector3d::UnitY());
  picture.solids.push_back({{.extent = {end + l, .5 * l, .05 * l}},
                            slope * rex::translation((end - l) / 2, 0, -.025 * l),
                            {.75f, .77f, .8f},
                            "slope"});
  const Eigen::Vector4d& x = motion.states[i];
  const double hipX = motion.feet[i] * std::cos(walker.slope) - l * std::sin(x[0]),
               hipZ = -motion.feet[i] * std::sin(walker.slope) + l * std::cos(x[0]);
  for (const bool stands : {true, false}) {
    const double angle = x[stands ? 0 : 1];
    const bool isLeft = stands == motion.leftStands[i];
    const rex::Color color = isLeft ? kBlue : kOrange;
    // So far down the leg from the hip.
    const auto placed = [&](double down) {
      return rex::translation(hipX, (isLeft ? .08 : -.08) * l, hipZ) *
             rex::rotation(-angle, Eigen::Vector3d::UnitY()) * rex::translation(0, 0, -down);
    };
    picture.solids.push_back({{.type = rex::ShapeType::kCapsule, .extent = {0, 0, l}, .radius = thick},
                              placed(l / 2),
                              color,
                              "leg"});
    picture.solids.push_back(
        {{.type = rex::ShapeType::kSphere, .radius = 2.5 * thick}, placed(walker.b), color, "leg mass"});
  }
  picture.solids.push_back({{.type = rex::ShapeType::kSphere, .radius = 4 * thick},
                            rex::translation(hipX, 0, hipZ),
                            {.35f, .37f, .42f},
                            "hip"});
  picture.ground.cell = .25 * l;
  picture.ground.height = -(end + l) * std::sin(walker.slope);
  return picture;
}

inline void filmWalker(const Walker& walker, const WalkerMotion& motion, const std::string& name) {
  rex::Film film;
  for (std::size_t i = 0; i < motion.states.size(); ++i)
    film.push_back({static_cast<double>(i) / 30, pictureOf(walker, motion, i)});
  writeBoth(film, name, {.15, -2, .25}, 900, 300);
}

/// The humanoid of the course as it looks, and as a model whose pelvis moves freely.
struct WalkingHumanoid {
  rex::Simulator look{"humanoid"};
  rex::Model model =
      rex::compile(rex::parseScene(look.description().sceneText, "humanoid.urdf", {.freeBase = true}).spec);
  Eigen::VectorXd start = model.initialPositions();  ///< with bent knees

  WalkingHumanoid() {
    for (const rex::Joint& joint : model.joints()) {
      const auto bends = [&](const char* name) { return joint.name.find(name) != std::string::npos; };
      if (bends("_hip_pitch") || bends("_ankle_pitch")) start[joint.qIndex] = -.35;
      if (bends("_knee")) start[joint.qIndex] = .7;
      if (joint.type == rex::JointType::kFree) start.segment<3>(joint.qIndex) = Eigen::Vector3d(0, 0, .84);
    }
  }
};

/// Postures in the columns of Q, `step` seconds apart, on the plan's footprints, with the ways of centre of
/// mass and zero moment point on the ground.
inline void filmHumanoid(const WalkingHumanoid& humanoid, const Eigen::MatrixXd& Q, double step,
                         const rex::WalkPlan& plan, const Points& center, const Points& zmp,
                         const std::string& name) {
  const auto onGround = [](const Eigen::Vector2d& p) { return Eigen::Vector3d(p.x(), p.y(), .004); };
  rex::Film film;
  for (int i = 0;; ++i) {
    const auto k = static_cast<Eigen::Index>(std::lround(i / (30 * step)));
    if (k >= Q.cols()) break;
    rex::Picture picture =
        rex::pictureOf(humanoid.look.model(), rex::forwardKinematics(humanoid.model, Q.col(k)));
    for (const rex::Footstep& foot : plan.footsteps)
      picture.solids.push_back(
          {{.extent = {plan.sole.length, plan.sole.width, .002}},
           rex::translation(foot.p.x(), foot.p.y(), .001) * rex::rotation(foot.yaw, Eigen::Vector3d::UnitZ()),
           {.7f, .72f, .76f},
           "footprint"});
    rex::Polyline middle{.color = kBlue}, pressure{.color = kOrange};
    const auto now = static_cast<std::size_t>(k);
    for (std::size_t j = 0; j <= now; ++j) {
      middle.points.push_back(onGround(center[j]));
      pressure.points.push_back(onGround(zmp[j]));
    }
    if (now > 0) picture.polylines = {middle, pressure};
    picture.pointSets.push_back({.points = {onGround(zmp[now])}, .color = kOrange, .size = 9});
    film.push_back({static_cast<double>(i) / 30, std::move(picture)});
  }
  writeBoth(film, name, {.7, -1, .55}, 640, 480);
}

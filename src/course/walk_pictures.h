#pragma once

#include <vector>

#include "locomotion/compass_gait.h"
#include "locomotion/footsteps.h"
#include "locomotion/walking_pattern.h"
#include "render/figure.h"
#include "render/film.h"

namespace rex {

/// The footprints of a plan seen from above, as grey regions; you may add series and everything else.
/// Throws Error as duration() does.
[[nodiscard]] Figure footprintFigure(const WalkPlan& plan);

/// A compass walker at one moment.
struct CompassView {
  Eigen::Vector4d x{0, 0, 0, 0};  ///< state, as in CompassGait
  double foot = 0;                ///< position of the stance foot, metres down the slope
  bool leftStands = true;         ///< whether the stance leg is the left, blue one; the other is orange
};

/// Its walk down the slope.
struct CompassWalk {
  CompassGait walker{};
  std::vector<CompassView> views{};
};

/// One of the views, on the slope of the whole walk. Throws Error if there is no such view, and for numbers
/// that are not finite.
[[nodiscard]] Picture compassPicture(const CompassWalk& walk, int view);

/// All views, `step` seconds apart. Throws Error as compassPicture() does.
[[nodiscard]] Film compassFilm(const CompassWalk& walk, double step);

/// The course's humanoid, alone or on a floor: shapes of the world. Its feet are to start from `start`, with
/// bent knees.
struct CourseHumanoid {
  Model model;
  Legs legs{};
  Eigen::VectorXd start{};
};
[[nodiscard]] CourseHumanoid courseHumanoid(const std::vector<ShapeSpec>& floor = {});

/// The course's humanoid on the footsteps of a plan, and two paths on the ground, sampled at the steps of
/// the preview.
struct HumanoidWalk {
  WalkPlan plan{};
  PreviewOptions preview{.height = 0.8, .step = 0.01};
  std::vector<Eigen::Vector2d> center{};  ///< path of the centre of mass, metres: blue
  std::vector<Eigen::Vector2d> zmp{};     ///< path of the zero moment point, metres: orange, with a dot
};

/// The course's humanoid, whose joints follow walkingPattern(), one frame for each step of the preview.
/// Throws Error if there is no such pattern, if the paths do not have its length, and for numbers that are
/// not finite.
[[nodiscard]] Film humanoidFilm(const HumanoidWalk& walk);

}  // namespace rex

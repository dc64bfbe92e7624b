#pragma once

#include <string>
#include <vector>

#include "course/plant_film.h"
#include "locomotion/compass_gait.h"
#include "locomotion/footsteps.h"
#include "locomotion/preview_control.h"
#include "render/figure.h"
#include "render/picture.h"

namespace rex {

/// The soles of a plan seen from above, as grey regions; series and all else may be added. Throws Error as
/// duration().
[[nodiscard]] Figure footprintFigure(const WalkPlan& plan);

/// A compass walker at one moment.
struct CompassView {
  Eigen::Vector4d x = Eigen::Vector4d::Zero();  ///< its state, as CompassGait takes it
  double foot = 0;                              ///< metres down the slope, of the foot that stands
  bool leftStands = true;                       ///< the blue leg; the other one is orange
};

/// Its way down the slope.
struct CompassWalk {
  CompassGait walker{};
  std::vector<CompassView> views{};
};

/// One of the views, on the slope of all. Throws Error where there is none, and for numbers that are not
/// finite.
[[nodiscard]] Picture pictureOf(const CompassWalk& walk, int view);

/// Draws the views, one for each step, into the folder NAME, the video NAME.mp4 and the contact sheet
/// NAME_sheet.png. Throws as pictureOf() and the films of racers (course/racer_pictures.h).
void writeFilm(const CompassWalk& walk, const std::string& name, const PlantFilmOptions& options = {});

/// The course's humanoid on the footsteps of a plan, and two ways on the ground, in steps of the preview.
struct HumanoidWalk {
  WalkPlan plan{};
  PreviewOptions preview{.height = 0.8, .step = 0.01};
  std::vector<Eigen::Vector2d> center{};  ///< metres, blue: of its centre of mass
  std::vector<Eigen::Vector2d> zmp{};     ///< metres, orange: the zero moment point, with a dot where it is
};

/// The same of a humanoid whose joints move by walkingPattern(). The step is that of the preview. Throws
/// Error where there is no such pattern, for ways of another length than it has, and for numbers that are not
/// finite.
void writeFilm(const HumanoidWalk& walk, const std::string& name, const PlantFilmOptions& options = {});

}  // namespace rex

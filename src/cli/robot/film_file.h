#pragma once

#include <filesystem>

#include "cli/robot/motion_pictures.h"
#include "cli/robot/render_plan.h"
#include "render/video_sink.h"

namespace rex::cli {

inline constexpr double kFilmRate = VideoOptions().rate;  ///< frames per second

/// Throws UsageError naming --no-film for a scene without a visible shape.
void requireFilmable(const Model& model);

/// Draws the pictures according to the plan into the film `out` or, without ffmpeg, into a folder of frames
/// next to it, and returns its path. A single picture becomes a walk around the scene. Nothing is created
/// until something is visible. Throws like Studio and makeFrameSink().
std::filesystem::path writeFilm(const MotionPictures& pictures, const RenderPlan& plan,
                                std::filesystem::path out);

}  // namespace rex::cli

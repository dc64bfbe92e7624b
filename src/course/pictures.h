#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "render/camera.h"
#include "render/gl_context.h"

namespace rex {

/// The OpenGL implementation for a student's program: the one named by REX_GL in the environment, or else
/// any that works. Such a program has no command line on which to choose. Throws Error naming the choices.
[[nodiscard]] GlOptions glChoice();

class Simulator;

/// What pictures of a simulator show besides the robot. Everything is in the world frame, in metres.
struct PictureOptions {
  std::string caption{};              ///< in the top left corner
  std::vector<std::string> traces{};  ///< bodies whose path through the recording is drawn as a line
  std::vector<std::vector<Eigen::Vector3d>> paths{};  ///< lines, such as the desired path of a hand
  std::vector<Eigen::Vector3d> points{};              ///< dots, such as targets
  Eigen::Vector3d view = kDefaultView;                ///< direction from the scene to the camera
  int width = 640, height = 480;                      ///< pixels
};

/// Draws the present posture into `file`, a .png. Throws Error for an unknown body in `traces`, a file that
/// cannot be written, or a machine without software OpenGL.
void writePicture(const Simulator& simulator, const std::string& file, const PictureOptions& options = {});

/// Draws the recording as folder/0000.png, 0001.png, ..., at most `most` frames, evenly spaced and seen
/// from one camera; by default 30 for each second of motion, at most 900 (see makeFilm() in course/film.h).
/// Frames of an earlier run in that folder are removed first. Ctrl-C leaves only complete files. Throws as
/// writePicture, and Error if `most` is below 2.
void writeFrames(const Simulator& simulator, const std::string& folder, const PictureOptions& options = {},
                 std::optional<int> most = {});

/// Calls writeFrames() for the folder NAME, and makes the video NAME.mp4 of the frames. Without ffmpeg
/// there are only the frames, and a line on standard error says so. The video plays in real time, at 30
/// frames per second, or at the nearest whole number if there are fewer. Postures that were set without a
/// time are 1/30 s apart, even if `most` leaves some out. Throws as writeFrames, and Error if ffmpeg fails.
void writeVideo(const Simulator& simulator, const std::string& name, const PictureOptions& options = {},
                std::optional<int> most = {});

/// Draws evenly spaced moments of the recording side by side into NAME.png: at most `pictures`, including
/// the first and last, with the times they have in the film that writeVideo() makes of at most `most`
/// frames. Throws as writeFrames, and Error if nothing is recorded or `pictures` is below 2.
void writeContactSheet(const Simulator& simulator, const std::string& name,
                       const PictureOptions& options = {}, int pictures = 6, std::optional<int> most = {});

}  // namespace rex

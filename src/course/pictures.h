#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "render/camera.h"

namespace rex {

class Simulator;

/// What pictures of a simulator show besides the robot. Everything is in the world frame, metres.
struct PictureOptions {
  std::string caption{};              ///< in the top left corner
  std::vector<std::string> traces{};  ///< bodies whose way through the recording is drawn as a line
  std::vector<std::vector<Eigen::Vector3d>> paths{};  ///< lines, such as the way a hand should take
  std::vector<Eigen::Vector3d> points{};              ///< dots, such as targets
  Eigen::Vector3d view = kDefaultView;  ///< the direction in which the camera stands, from the scene
  int width = 640, height = 480;        ///< pixels
};

/// Draws the present posture into `file`, a .png. Throws Error for an unknown body in `traces`, a file that
/// cannot be written, or a machine without software OpenGL.
void writePicture(const Simulator& simulator, const std::string& file, const PictureOptions& options = {});

/// Draws the recording as folder/0000.png, 0001.png, ..., at most `most` frames, evenly spaced and seen from
/// one place; by default 30 for each second of motion, 900 at most (see filmOf() in course/film.h). Frames of
/// an earlier run in that folder go first. Ctrl-C leaves whole files. Throws as writePicture, and Error when
/// `most` is below 2.
void writeFrames(const Simulator& simulator, const std::string& folder, const PictureOptions& options = {},
                 std::optional<int> most = {});

/// writeFrames() into the folder NAME, and the video NAME.mp4 of them. Without ffmpeg there are only the
/// frames, and a line on standard error says so. It plays in real time, at 30 frames a second or the whole
/// number that fits fewer; postures that were set without a time are 1/30 s apart, also where `most` leaves
/// some out. Throws as writeFrames, and Error when ffmpeg fails.
void writeVideo(const Simulator& simulator, const std::string& name, const PictureOptions& options = {},
                std::optional<int> most = {});

/// Draws moments of the recording, evenly spaced, side by side into NAME.png: at most `pictures`, first and
/// last included, with the times they have in the film that writeVideo() makes of at most `most` frames.
/// Throws as writeFrames, and Error when nothing is recorded or `pictures` is below 2.
void writeContactSheet(const Simulator& simulator, const std::string& name,
                       const PictureOptions& options = {}, int pictures = 6, std::optional<int> most = {});

}  // namespace rex

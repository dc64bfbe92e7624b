#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "course/pictures.h"
#include "render/camera.h"
#include "render/figure.h"
#include "render/film.h"

namespace rex {

/// The camera and the picture size of a film.
struct Shot {
  Camera camera{};
  int width = 640, height = 480;  ///< pixels
};

/// How pictures and films that a program makes itself are drawn.
struct FilmOptions {
  Eigen::Vector3d view{0.35, -2, 0.45};  ///< direction from the scene to the camera
  std::optional<Camera> camera{};        ///< instead of the one that sees everything from there
  int width = 640, height = 480;         ///< pixels
  double speed = 1;                      ///< seconds of the film that the video shows per second
  int moments = 6;                       ///< pictures in the contact sheet, at least 2
};

/// Draws the picture into `file`, a .png. The camera sees the whole scene; the ground fades out around it.
/// Throws Error for a size out of range, an empty picture, a file that cannot be written, or a machine
/// without software OpenGL.
void writePicture(const Picture& picture, const std::string& file, const FilmOptions& options = {});

/// The pictures frame(0), ..., frame(count - 1), `step` seconds apart.
[[nodiscard]] Film makeFilm(int count, double step, const std::function<Picture(int)>& frame);

/// Draws a film whose frames are evenly spaced in time into the folder NAME as 0000.png, 0001.png, ..., the
/// video NAME.mp4, and the contact sheet NAME_sheet.png of evenly spaced moments, all from the same camera.
/// Of frames that are closer than the video shows at kFilmRate, some are left out. Without ffmpeg there is no
/// video, and a line on standard error says so. Throws as writePicture() does, and Error for a film without
/// frames, times that do not increase, a speed that is not positive, and fewer than 2 moments.
void writeFilm(const Film& film, const std::string& name, const FilmOptions& options = {});

/// Draws the film as folder/0000.png, 0001.png, ... and first removes frames of an earlier run from that
/// folder. Ctrl-C leaves only complete files. The functions in this file throw Error for a size out of
/// range, files that cannot be written, a machine without software OpenGL, and as drawFilm() does.
void writeFilmFrames(const Film& film, const Shot& shot, const std::string& folder);

/// The same into the folder NAME, with the video NAME.mp4 at `rate` frames per second. Without ffmpeg there
/// are only the frames, and a line on standard error says so.
void writeFilmVideo(const Film& film, const Shot& shot, const std::string& name, int rate);

/// Draws at most `pictures` moments of the film, evenly spaced and including the first and last, side by
/// side into `file`, a .png, with their times. Also throws Error for fewer than 2 pictures.
void writeFilmSheet(const Film& film, const Shot& shot, const std::string& file, int pictures);

inline constexpr int kFilmRate = 30;  ///< frames per second of a simulator's film

/// The default maximum of frames in a film: those of half a minute. Longer motions get fewer frames per
/// second.
inline constexpr int kMostFrames = 900;

/// The recording as a film of at most `most` postures, evenly spaced in time, with what the options add:
/// traces up to each moment, paths, points and the caption. Frames have the times of the motion, starting
/// at 0; see Recording::evenly() for postures without times. By default there are kFilmRate frames per
/// second of motion, but at most kMostFrames. Throws Error for an unknown body in `traces` and if `most` is
/// below 2.
[[nodiscard]] Film makeFilm(const Simulator& simulator, const PictureOptions& options,
                            std::optional<int> most = {});

/// The same for any postures, each given by its joint angles, at kFilmRate per second.
[[nodiscard]] Film makeFilm(const Simulator& simulator, const std::vector<Eigen::VectorXd>& postures,
                            const PictureOptions& options);

/// The present posture as a film of one frame, with the traces of the recording up to it.
[[nodiscard]] Film makeStill(const Simulator& simulator, const PictureOptions& options);

/// The frame rate, 1 to kFilmRate per second, at which a video of the film's frames plays closest to real
/// time.
[[nodiscard]] int videoRate(const Film& film);

/// The camera that sees the whole film from the direction that the options ask for.
[[nodiscard]] Camera cameraFor(const Film& film, const PictureOptions& options);

/// Writes the recording as NAME.html, a self-contained page for any browser, in which the motion plays in
/// real time and can be turned, next to the `figures`. It has at most `most` frames, evenly spaced, by
/// default as many as writeFrames(); without a recording it shows the present posture. Throws as
/// writeFrames and plot.
void writeReplay(const Simulator& simulator, const std::string& name, const PictureOptions& options = {},
                 const std::vector<Figure>& figures = {}, std::optional<int> most = {});

}  // namespace rex

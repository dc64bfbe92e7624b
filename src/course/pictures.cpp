#include "course/pictures.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "course/recording.h"
#include "course/simulator.h"
#include "render/film.h"
#include "render/png.h"
#include "render/renderer.h"
#include "render/scene_picture.h"
#include "render/video.h"

namespace rex {
namespace {

constexpr double kRate = 30;  // frames per second
const Color kTraceColor{0.84f, 0.37f, 0.0f};
const Color kPathColor{0.35f, 0.45f, 0.55f};
const Color kPointColor{0.80f, 0.10f, 0.12f};

Picture decorate(Picture picture, const PictureOptions& options) {
  for (const auto& path : options.paths)
    picture.polylines.push_back({.points = path, .color = kPathColor, .width = 1.5});
  if (!options.points.empty())
    picture.pointSets.push_back({.points = options.points, .color = kPointColor, .size = 9});
  if (!options.caption.empty()) picture.captions.push_back({.text = options.caption});
  return picture;
}

double aspect(const PictureOptions& options) { return static_cast<double>(options.width) / options.height; }

// The ways of the traced bodies, one per body, through all the poses.
std::vector<std::vector<Eigen::Vector3d>> tracesOf(const Simulator& simulator,
                                                   const std::vector<BodyPoses>& poses,
                                                   const PictureOptions& options) {
  std::vector<std::vector<Eigen::Vector3d>> traces;
  for (const std::string& name : options.traces) {
    const BodyId body = simulator.model().body(name);
    traces.emplace_back();
    for (const BodyPoses& at : poses) traces.back().push_back(at[body].p);
  }
  return traces;
}

// A picture of each posture, with the traces up to it.
Film filmOf(const Simulator& simulator, const std::vector<Eigen::VectorXd>& postures,
            const PictureOptions& options) {
  std::vector<BodyPoses> poses;
  for (const Eigen::VectorXd& q : postures) poses.push_back(forwardKinematics(simulator.model(), q));
  const auto traces = tracesOf(simulator, poses, options);
  Film film;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    film.push_back(
        {static_cast<double>(i) / kRate, decorate(pictureOf(simulator.model(), poses[i]), options)});
    if (i == 0) continue;
    for (const auto& trace : traces) {
      const auto end = trace.begin() + static_cast<std::ptrdiff_t>(i) + 1;
      film.back().picture.polylines.push_back(
          {.points = {trace.begin(), end}, .color = kTraceColor, .width = 2.5});
    }
  }
  levelGround(film);
  return film;
}

void removeFrames(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string();
    const bool isNumber = !stem.empty() && std::all_of(stem.begin(), stem.end(),
                                                       [](unsigned char c) { return std::isdigit(c); });
    if (isNumber && entry.path().extension() == ".png") std::filesystem::remove(entry.path());
  }
}

}  // namespace

void writePicture(const Simulator& simulator, const std::string& file, const PictureOptions& options) {
  std::vector<Eigen::VectorXd> postures;
  if (!options.traces.empty()) postures = simulator.recording().evenly(Recording::kCapacity);
  postures.push_back(simulator.getJointAngles());
  const Picture picture = std::move(filmOf(simulator, postures, options).back().picture);
  Renderer renderer({.width = options.width, .height = options.height});
  writePng(renderer.draw(picture, framing(bounds(picture), options.view, aspect(options))), file);
}

void writeFrames(const Simulator& simulator, const std::string& folder, const PictureOptions& options,
                 int most) {
  const Film film =
      filmOf(simulator, simulator.recording().evenly(static_cast<std::size_t>(std::max(most, 0))), options);
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (!std::filesystem::is_directory(folder, problem)) {
    throw Error({.what = "cannot make the folder for frames", .where = {folder}, .found = problem.message()});
  }
  removeFrames(folder);
  if (film.empty()) return;
  const Camera camera = framing(film, options.view, aspect(options));
  Renderer renderer({.width = options.width, .height = options.height});
  for (std::size_t i = 0; i < film.size(); ++i)
    writePng(renderer.draw(film[i].picture, camera),
             (std::filesystem::path(folder) / fmt::format("{:04}.png", i)).string());
}

void writeVideo(const Simulator& simulator, const std::string& name, const PictureOptions& options,
                int most) {
  writeFrames(simulator, name, options, most);
  if (simulator.recording().empty() || joinToVideo(name, name + ".mp4")) return;
  fmt::print(stderr, "{}.mp4 is missing because ffmpeg is (apt-get install ffmpeg); the frames are in {}\n",
             name, name);
}

}  // namespace rex

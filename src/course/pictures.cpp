#include "course/pictures.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "course/recording.h"
#include "course/simulator.h"
#include "render/png.h"
#include "render/renderer.h"
#include "render/scene_picture.h"
#include "render/video.h"

namespace rex {
namespace {

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

void includeAll(Bounds& all, const Bounds& more) {
  if (more.isEmpty()) return;
  all.include(more.low);
  all.include(more.high);
}

Camera cameraFor(const Bounds& all, const PictureOptions& options) {
  return framing(all, options.view, static_cast<double>(options.width) / options.height);
}

// The frames of a recording: poses of each posture, and the ways of the traced bodies up to it.
struct Film {
  std::vector<BodyPoses> poses;
  std::vector<std::vector<Eigen::Vector3d>> traces;  // one per traced body
};

Film develop(const Simulator& simulator, const std::vector<Eigen::VectorXd>& postures,
             const PictureOptions& options) {
  Film film;
  for (const Eigen::VectorXd& q : postures) film.poses.push_back(forwardKinematics(simulator.model(), q));
  for (const std::string& name : options.traces) {
    const BodyId body = simulator.model().body(name);
    film.traces.emplace_back();
    for (const BodyPoses& poses : film.poses) film.traces.back().push_back(poses[body].p);
  }
  return film;
}

Picture frame(const Simulator& simulator, const Film& film, std::size_t i, const PictureOptions& options) {
  Picture picture = decorate(pictureOf(simulator.model(), film.poses[i]), options);
  for (const auto& trace : film.traces) {
    const std::vector<Eigen::Vector3d> soFar(trace.begin(),
                                             trace.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    if (soFar.size() > 1) picture.polylines.push_back({.points = soFar, .color = kTraceColor, .width = 2.5});
  }
  return picture;
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
  std::vector<Eigen::VectorXd> postures = {simulator.getJointAngles()};
  if (!options.traces.empty()) postures = simulator.recording().evenly(Recording::kCapacity);
  postures.push_back(simulator.getJointAngles());
  const Film film = develop(simulator, postures, options);
  const Picture picture = frame(simulator, film, film.poses.size() - 1, options);
  Renderer renderer({.width = options.width, .height = options.height});
  writePng(renderer.draw(picture, cameraFor(bounds(picture), options)), file);
}

void writeFrames(const Simulator& simulator, const std::string& folder, const PictureOptions& options,
                 int most) {
  const Film film =
      develop(simulator, simulator.recording().evenly(static_cast<std::size_t>(std::max(most, 0))), options);
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (!std::filesystem::is_directory(folder, problem)) {
    throw Error({.what = "cannot make the folder for frames", .where = {folder}, .found = problem.message()});
  }
  removeFrames(folder);
  if (film.poses.empty()) return;

  std::vector<Picture> pictures;
  Bounds all;
  double ground = 0;
  for (std::size_t i = 0; i < film.poses.size(); ++i) {
    pictures.push_back(frame(simulator, film, i, options));
    includeAll(all, bounds(pictures.back()));
    ground = std::min(ground, pictures.back().ground.height);
  }
  const Camera camera = cameraFor(all, options);
  Renderer renderer({.width = options.width, .height = options.height});
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    pictures[i].ground.height = ground;  // one floor for the whole film
    writePng(renderer.draw(pictures[i], camera),
             (std::filesystem::path(folder) / fmt::format("{:04}.png", i)).string());
  }
}

void writeVideo(const Simulator& simulator, const std::string& name, const PictureOptions& options,
                int most) {
  writeFrames(simulator, name, options, most);
  if (simulator.recording().empty() || joinToVideo(name, name + ".mp4")) return;
  fmt::print(stderr, "{}.mp4 is missing because ffmpeg is (apt-get install ffmpeg); the frames are in {}\n",
             name, name);
}

}  // namespace rex

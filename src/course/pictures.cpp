#include "course/pictures.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "course/film.h"
#include "course/recording.h"
#include "course/simulator.h"
#include "render/png.h"
#include "render/renderer.h"
#include "render/video.h"

namespace rex {
namespace {

double aspect(const PictureOptions& options) { return static_cast<double>(options.width) / options.height; }

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
  const Film film = filmOf(simulator, options, most);
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

#include "cli/robot/motion_files.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <numeric>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/robot/film_file.h"
#include "cli/robot/motion_pictures.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

// A folder that holds anything but frames stays.
void removeFrames(const fs::path& folder) {
  std::error_code unused;
  for (int i = 0; fs::remove(folder / fmt::format("{:04}.png", i), unused); ++i) {
  }
  if (fs::is_directory(folder, unused)) fs::remove(folder, unused);
}

[[noreturn]] void refuse(const fs::path& path, const std::string& found, const std::string& wanted) {
  throw UsageError({.what = "-o " + harmless(path.string()), .found = found, .wanted = wanted});
}

}  // namespace

double filmSpeed(double asked, double seconds) {
  const double speed = std::max(asked, seconds / kLongestFilm);
  if (speed > asked)
    note(fmt::format("the film plays {:.3g} times as fast as the motion, so that it lasts {:g} s", speed,
                     kLongestFilm));
  return speed;
}

void requireFolderName(const fs::path& folder, const std::string& wanted) {
  const std::string ending = folder.extension().string();
  for (const char* ofFiles : {".mp4", ".png", ".glb", ".html", ".csv", ".npy", ".ors", ".urdf"})
    if (ending == ofFiles) refuse(folder, "the name of a file", wanted);
}

void makeResultFolder(const fs::path& folder, std::initializer_list<const char*> files,
                      const std::string& frames) {
  requireFolderName(folder, "a folder");
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem || !fs::is_directory(folder))
    refuse(folder, problem ? problem.message() : "a file", "a folder");
  if (!std::ofstream(folder / *files.begin(), std::ios::app))
    refuse(folder, std::strerror(errno), "a folder to write to");
  removeFrames(folder / frames);
  for (const char* name : files) {
    fs::remove(folder / name, problem);
    if (problem) refuse(folder / name, problem.message(), "a file, or nothing");
  }
}

std::vector<fs::path> writeFilmAndReplay(const Model& model, const Motion& motion, BodyId body, Report report,
                                         const RenderPlan& pictures, const fs::path& stem, double speed) {
  std::vector<std::size_t> frames(motion.postures.size());
  std::iota(frames.begin(), frames.end(), std::size_t{0});
  const MotionPictures shots(model, motion, frames, {model[body].name}, report.title);
  const fs::path film = writeFilm(shots, pictures, fs::path(stem).concat(".mp4"));
  report.film = shots.film();
  for (Frame& frame : report.film) frame.time /= speed;
  if (speed != 1) report.facts.emplace_back("speed of the replay", fmt::format("{:g}", speed));
  report.view = pictures.views.front().view.direction();
  report.still.gl = pictures.renderer.gl;
  for (ReportFigure& item : report.figures) item.figure.width = 560, item.figure.height = 360;
  const fs::path page = fs::path(stem).concat(".html");
  writeReport(report, page);
  return {film, page};
}

}  // namespace rex::cli

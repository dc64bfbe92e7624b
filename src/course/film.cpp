#include "course/film.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/interruption.h"
#include "base/require.h"
#include "course/film_internal.h"
#include "course/pictures.h"
#include "course/recording.h"
#include "course/simulator.h"
#include "kinematics/forward_kinematics.h"
#include "render/contact_sheet.h"
#include "render/film.h"
#include "render/frame_sink.h"
#include "render/image.h"
#include "render/picture.h"
#include "render/report.h"
#include "render/video_sink.h"
#include "scene/model.h"

namespace rex {
namespace {

// Student programs do not handle Ctrl-C, so it is deferred until the files are complete.
void beforeSignals(const std::function<void()>& work) {
  int signal = 0;
  {
    const HeldSignals held;
    try {
      work();
    } catch (const Interrupted& stop) {
      signal = stop.signal;
    }
  }
  if (signal != 0) std::raise(signal);
}

void drawInto(FrameSink& sink, const Film& film, const Shot& shot) {
  Renderer renderer(
      {.width = shot.width, .height = shot.height, .antiAliasing = kFilmAntiAliasing, .gl = glChoice()});
  drawFilm(film, shot.camera, renderer, sink);
}

}  // namespace

void writeFilmFrames(const Film& film, const Shot& shot, const std::string& folder) {
  beforeSignals([&] {
    PngSequence frames(folder);
    drawInto(frames, film, shot);
  });
}

void writeFilmVideo(const Film& film, const Shot& shot, const std::string& name, int rate) {
  // The error of the video, thrown even without ffmpeg.
  if (rate < 1 || rate > 1000)
    throw Error(
        {.what = name + ".mp4: frames per second", .found = fmt::format("{}", rate), .wanted = "1 to 1000"});
  beforeSignals([&] {
    std::vector<std::unique_ptr<FrameSink>> sinks;
    sinks.push_back(std::make_unique<PngSequence>(name));
    MadeSink video = makeFrameSink(name + ".mp4", {.rate = rate});
    // If no video can be made, that of an earlier run is not left next to frames that differ.
    if (video.sink)
      sinks.push_back(std::move(video.sink));
    else
      std::filesystem::remove(name + ".mp4");
    TeeSink both(std::move(sinks));
    drawInto(both, film, shot);
    if (!video.missing.empty()) fmt::print(stderr, "{}; the frames are in {}\n", video.missing, name);
  });
}

void writeFilmSheet(const Film& film, const Shot& shot, const std::string& file, int pictures) {
  const ContactSheetOptions layout{.pictures = pictures};
  requireValid(layout);
  requireValid(RendererOptions{.width = shot.width, .height = shot.height});
  // Drawn at the size at which they appear, text stays readable.
  const int width = std::min(shot.width, layout.pictureWidth);
  const int height = std::max(shot.height * width / shot.width, 1);
  Renderer renderer({.width = width, .height = height, .gl = glChoice()});
  Film moments;
  for (const std::size_t k : keyFrames(film.size(), pictures)) moments.push_back(film[k]);
  MemorySink drawn;
  drawFilm(moments, shot.camera, renderer, drawn);
  std::vector<KeyFrame> shown;
  for (std::size_t i = 0; i < moments.size(); ++i)
    shown.push_back({drawn.frames()[i], fmt::format("{:.2f} s", moments[i].time)});
  writePng(contactSheet(shown, layout), file);
}

namespace {

Bounds groundOf(const Film& film) {
  Bounds all;
  for (const Frame& frame : film) {
    const Bounds& scene = frame.picture.ground.scene;
    if (scene.isEmpty()) continue;
    all.include(scene.low);
    all.include(scene.high);
  }
  return all;
}

Shot shotFor(const Film& film, const FilmOptions& options) {
  requireValid(RendererOptions{.width = options.width, .height = options.height});
  const double aspect = static_cast<double>(options.width) / options.height;
  const Bounds ground = groundOf(film);
  const auto all = [&] { return framing(ground.isEmpty() ? bounds(film) : ground, options.view, aspect); };
  return {options.camera ? *options.camera : all(), options.width, options.height};
}

}  // namespace

void writePicture(const Picture& picture, const std::string& file, const FilmOptions& options) {
  const Shot shot = shotFor({{0, picture}}, options);
  Renderer renderer({.width = shot.width, .height = shot.height, .gl = glChoice()});
  writePng(renderer.draw(picture, shot.camera), file);
}

Film makeFilm(int count, double step, const std::function<Picture(int)>& frame) {
  Film film;
  for (int i = 0; i < count; ++i) film.push_back({i * step, frame(i)});
  return film;
}

internal::FilmPace internal::filmPace(int count, double step, double speed) {
  const double perFrame = std::clamp(speed / (kFilmRate * step), 1., static_cast<double>(count));
  FilmPace pace;
  for (int i = 0; std::lround(i * perFrame) < count; ++i)
    pace.frames.push_back(static_cast<std::size_t>(std::lround(i * perFrame)));
  pace.rate = static_cast<int>(std::clamp(std::round(speed / (perFrame * step)), 1., 1. * kFilmRate));
  return pace;
}

void writeFilm(const Film& film, const std::string& name, const FilmOptions& options) {
  if (film.empty())
    throw Error({.what = "film '" + name + "'", .found = "no frames", .wanted = "at least one"});
  const int count = static_cast<int>(film.size());
  const double step = count > 1 ? (film.back().time - film.front().time) / (count - 1) : 1. / kFilmRate;
  requirePositive("film '" + name + "': time between frames", step, kSeconds);
  requirePositive("film '" + name + "': speed", options.speed);
  requireValid(ContactSheetOptions{.pictures = options.moments});
  const internal::FilmPace pace = internal::filmPace(count, step, options.speed);
  Film shown;
  for (const std::size_t i : pace.frames) shown.push_back(film[i]);
  if (groundOf(shown).isEmpty()) settleGround(shown);
  const Shot shot = shotFor(shown, options);
  writeFilmVideo(shown, shot, name, pace.rate);
  writeFilmSheet(shown, shot, name + "_sheet.png", options.moments);
}

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

// The paths of the traced bodies through all the poses, one per body.
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

// There is a frame at both ends.
int framesFor(double seconds) {
  return static_cast<int>(std::clamp(std::ceil(seconds * kFilmRate - 1e-9) + 1, 2., 1. * kMostFrames));
}

// From frame `first` on.
Film makeFilm(const Simulator& simulator, const std::vector<RecordedPosture>& moments,
              const PictureOptions& options, std::size_t first = 0) {
  std::vector<BodyPoses> poses;
  for (const RecordedPosture& one : moments) poses.push_back(forwardKinematics(simulator.model(), one.q));
  const auto traces = tracesOf(simulator, poses, options);
  Film film;
  for (std::size_t i = first; i < poses.size(); ++i) {
    film.push_back({moments[i].time, decorate(scenePicture(simulator.model(), poses[i]), options)});
    if (i == 0) continue;
    for (const auto& trace : traces) {
      const auto end = trace.begin() + static_cast<std::ptrdiff_t>(i) + 1;
      film.back().picture.polylines.push_back(
          {.points = {trace.begin(), end}, .color = kTraceColor, .width = 2.5});
    }
  }
  settleGround(film);
  return film;
}

}  // namespace

Film makeFilm(const Simulator& simulator, const PictureOptions& options, std::optional<int> most) {
  const Recording& recording = simulator.recording();
  const int asked = most.value_or(framesFor(recording.duration()));
  return makeFilm(simulator, recording.evenly(static_cast<std::size_t>(std::max(asked, 0))), options);
}

Film makeFilm(const Simulator& simulator, const std::vector<Eigen::VectorXd>& postures,
              const PictureOptions& options) {
  std::vector<RecordedPosture> moments;
  for (const Eigen::VectorXd& q : postures)
    moments.push_back({static_cast<double>(moments.size()) / kFilmRate, q});
  return makeFilm(simulator, moments, options);
}

Film makeStill(const Simulator& simulator, const PictureOptions& options) {
  std::vector<RecordedPosture> moments;
  if (!options.traces.empty()) moments = simulator.recording().evenly(Recording::kCapacity);
  moments.push_back({0, simulator.getJointAngles()});
  return makeFilm(simulator, moments, options, moments.size() - 1);
}

int videoRate(const Film& film) {
  if (film.size() < 2) return kFilmRate;
  const double seconds = film.back().time - film.front().time;
  const double rate = std::round(static_cast<double>(film.size() - 1) / seconds);
  return static_cast<int>(std::clamp(rate, 1., static_cast<double>(kFilmRate)));
}

Camera cameraFor(const Film& film, const PictureOptions& options) {
  return framing(film, options.view, static_cast<double>(options.width) / options.height);
}

void writeReplay(const Simulator& simulator, const std::string& name, const PictureOptions& options,
                 const std::vector<Figure>& figures, std::optional<int> most) {
  Report report{.title = options.caption.empty() ? name : options.caption,
                .film = makeFilm(simulator, options, most),
                .view = options.view,
                .still = {.width = options.width, .height = options.height, .gl = glChoice()}};
  if (report.film.empty()) report.film = makeFilm(simulator, {simulator.getJointAngles()}, options);
  for (Figure figure : figures) {
    figure.width = 560, figure.height = 360;  // a column next to the robot: a smaller figure has larger texts
    report.figures.push_back({.figure = std::move(figure)});
  }
  writeReport(report, name + ".html");
}

}  // namespace rex

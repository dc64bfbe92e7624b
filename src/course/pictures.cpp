#include "course/pictures.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <functional>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/interruption.h"
#include "course/film.h"
#include "course/gl_choice.h"
#include "course/recording.h"
#include "course/simulator.h"
#include "render/contact_sheet.h"
#include "render/draw_film.h"
#include "render/make_frame_sink.h"
#include "render/memory_sink.h"
#include "render/png.h"
#include "render/png_sequence.h"
#include "render/tee_sink.h"

namespace rex {
namespace {

// A student's program has no edge at which Ctrl-C could wait until nothing half made lies about.
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

void drawInto(FrameSink& sink, const Film& film, const PictureOptions& options) {
  Renderer renderer({.width = options.width,
                     .height = options.height,
                     .antiAliasing = kFilmAntiAliasing,
                     .gl = glChoice()});
  drawFilm(film, cameraFor(film, options), renderer, sink);
}

}  // namespace

void writePicture(const Simulator& simulator, const std::string& file, const PictureOptions& options) {
  std::vector<Eigen::VectorXd> postures;
  if (!options.traces.empty()) postures = simulator.recording().evenly(Recording::kCapacity);
  postures.push_back(simulator.getJointAngles());
  Film film = filmOf(simulator, postures, options);
  film.erase(film.begin(), film.end() - 1);
  Renderer renderer({.width = options.width, .height = options.height, .gl = glChoice()});
  writePng(renderer.draw(film.front().picture, cameraFor(film, options)), file);
}

void writeFrames(const Simulator& simulator, const std::string& folder, const PictureOptions& options,
                 int most) {
  const Film film = filmOf(simulator, options, most);
  if (film.empty()) return;
  beforeSignals([&] {
    PngSequence frames(folder);
    drawInto(frames, film, options);
  });
}

void writeVideo(const Simulator& simulator, const std::string& name, const PictureOptions& options,
                int most) {
  const Film film = filmOf(simulator, options, most);
  if (film.empty()) return;
  beforeSignals([&] {
    std::vector<std::unique_ptr<FrameSink>> sinks;
    sinks.push_back(std::make_unique<PngSequence>(name));
    MadeSink video = makeFrameSink(name + ".mp4", {.rate = kFilmRate});
    if (video.sink) sinks.push_back(std::move(video.sink));
    TeeSink both(std::move(sinks));
    drawInto(both, film, options);
    if (!video.missing.empty()) fmt::print(stderr, "{}; the frames are in {}\n", video.missing, name);
  });
}

void writeContactSheet(const Simulator& simulator, const std::string& name, const PictureOptions& options,
                       int pictures, int most) {
  const ContactSheetOptions layout{.pictures = pictures};
  requireValid(layout);
  requireValid(RendererOptions{.width = options.width, .height = options.height});
  const Film film = filmOf(simulator, options, most);
  if (film.empty()) throw Error({.what = "no postures for a contact sheet", .where = {name + ".png"}});
  const Camera camera = cameraFor(film, options);
  // Drawn at the size at which they appear, text stays readable.
  const int width = std::min(options.width, layout.pictureWidth);
  const int height = std::max(options.height * width / options.width, 1);
  Renderer renderer({.width = width, .height = height, .gl = glChoice()});
  Film moments;
  for (const std::size_t k : keyFrames(film.size(), pictures)) moments.push_back(film[k]);
  MemorySink drawn;
  drawFilm(moments, camera, renderer, drawn);
  std::vector<KeyFrame> shown;
  for (std::size_t i = 0; i < moments.size(); ++i)
    shown.push_back({drawn.frames()[i], fmt::format("{:.2f} s", moments[i].time)});
  writePng(contactSheet(shown, layout), name + ".png");
}

}  // namespace rex

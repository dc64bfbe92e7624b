#include "course/film_files.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/interruption.h"
#include "course/gl_choice.h"
#include "render/contact_sheet.h"
#include "render/draw_film.h"
#include "render/make_frame_sink.h"
#include "render/memory_sink.h"
#include "render/png.h"
#include "render/png_sequence.h"
#include "render/tee_sink.h"

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

}  // namespace rex

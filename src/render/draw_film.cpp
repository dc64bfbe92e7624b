#include "render/draw_film.h"

#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/interruption.h"

namespace rex {
namespace {

[[noreturn]] void failForNothingSeen(const Film& film) {
  throw Error({.what = "the film shows nothing",
               .found = fmt::format("no solid, line or point in any of {} frames", film.size()),
               .wanted = "a camera that sees some of them; see framing()"});
}

}  // namespace

void drawFilm(const Film& film, const Camera& camera, Renderer& renderer, FrameSink& sink) {
  bool showsSomething = film.empty();  // about which the sink complains
  for (const Frame& frame : film) {
    throwIfInterrupted();
    const DrawnFrame drawn = renderer.drawFrame(frame.picture, camera);
    showsSomething |= drawn.showsSomething;
    sink.add(drawn.image);
  }
  if (!showsSomething) failForNothingSeen(film);
  sink.finish();
}

Image drawStill(const Film& film, const Camera& camera, Renderer& renderer) {
  for (const Frame& frame : film) {
    throwIfInterrupted();
    DrawnFrame drawn = renderer.drawFrame(frame.picture, camera);
    if (drawn.showsSomething) return std::move(drawn.image);
  }
  failForNothingSeen(film);
}

}  // namespace rex

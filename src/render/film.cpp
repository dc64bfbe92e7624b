#include "render/film.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/interruption.h"
#include "render/frame_sink.h"
#include "render/image.h"
#include "render/renderer.h"

namespace rex {

Bounds bounds(const Film& film) {
  Bounds all;
  for (const Frame& frame : film) {
    const Bounds one = bounds(frame.picture);
    if (one.isEmpty()) continue;
    all.include(one.low);
    all.include(one.high);
  }
  return all;
}

Camera framing(const Film& film, const Eigen::Vector3d& direction, double aspect) {
  return framing(bounds(film), direction, aspect);
}

void settleGround(Film& film) {
  const auto lower = [](const Frame& a, const Frame& b) {
    return a.picture.ground.height < b.picture.ground.height;
  };
  const auto lowest = std::min_element(film.begin(), film.end(), lower);
  if (lowest == film.end()) return;
  const double height = lowest->picture.ground.height;
  const Bounds scene = bounds(film);
  for (Frame& frame : film) {
    frame.picture.ground.height = height;
    frame.picture.ground.scene = scene;
  }
}

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

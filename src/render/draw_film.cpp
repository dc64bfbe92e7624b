#include "render/draw_film.h"

namespace rex {

void drawFilm(const Film& film, const Camera& camera, Renderer& renderer, FrameSink& sink) {
  for (const Frame& frame : film) sink.add(renderer.draw(frame.picture, camera));
  sink.finish();
}

}  // namespace rex

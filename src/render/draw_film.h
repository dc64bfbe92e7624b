#pragma once

#include "render/camera.h"
#include "render/film.h"
#include "render/frame_sink.h"
#include "render/renderer.h"

namespace rex {

/// What frames of a film are drawn with: in motion, nobody sees the difference to the best.
inline constexpr AntiAliasing kFilmAntiAliasing = AntiAliasing::kFxaa;

/// Draws all frames, seen from one camera, into the sink and finishes it. Throws as Renderer::drawFrame() and
/// the sink; Error when no frame shows anything; Interrupted for a signal of HeldSignals.
void drawFilm(const Film& film, const Camera& camera, Renderer& renderer, FrameSink& sink);

/// The first frame that shows something. Throws as drawFilm().
[[nodiscard]] Image drawStill(const Film& film, const Camera& camera, Renderer& renderer);

}  // namespace rex

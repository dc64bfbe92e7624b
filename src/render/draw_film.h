#pragma once

#include "render/camera.h"
#include "render/film.h"
#include "render/frame_sink.h"
#include "render/renderer.h"

namespace rex {

/// The anti-aliasing for frames of a film: in motion, the best one would look no different.
inline constexpr AntiAliasing kFilmAntiAliasing = AntiAliasing::kFxaa;

/// Draws all frames, seen from one camera, into the sink and finishes it. Throws as Renderer::drawFrame()
/// and the sink, Error if no frame shows anything, and Interrupted for a signal of HeldSignals.
void drawFilm(const Film& film, const Camera& camera, Renderer& renderer, FrameSink& sink);

/// The first frame that shows something. Throws as drawFilm().
[[nodiscard]] Image drawStill(const Film& film, const Camera& camera, Renderer& renderer);

}  // namespace rex

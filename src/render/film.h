#pragma once

#include <vector>

#include "render/camera.h"
#include "render/picture.h"

namespace rex {

class FrameSink;
class Renderer;
struct Image;

/// One moment of a motion.
struct Frame {
  double time = 0;  ///< seconds, increasing from frame to frame
  Picture picture{};
};

/// A motion as data, for frames, videos and replays. Items with the same index in successive pictures count
/// as one thing that moves.
using Film = std::vector<Frame>;

/// The box around everything that is ever shown; empty if nothing is.
[[nodiscard]] Bounds bounds(const Film& film);

/// The camera of framing() that sees the whole film.
[[nodiscard]] Camera framing(const Film& film, const Eigen::Vector3d& direction, double aspect);

/// Puts the ground of all pictures at the height of the lowest one and around the whole film, so that the
/// floor does not move.
void settleGround(Film& film);

/// Draws all frames, seen from one camera, into the sink and finishes it. Throws as Renderer::drawFrame()
/// and the sink, Error if no frame shows anything, and Interrupted for a signal of HeldSignals.
void drawFilm(const Film& film, const Camera& camera, Renderer& renderer, FrameSink& sink);

/// The first frame that shows something. Throws as drawFilm().
[[nodiscard]] Image drawStill(const Film& film, const Camera& camera, Renderer& renderer);

}  // namespace rex

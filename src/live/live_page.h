#pragma once

namespace rex {

class LiveServer;

/// Offers the page and all that it loads, except what it shows: scene.json, scene.glb or pieces, and the
/// frames.
void offerLivePage(LiveServer& server);

}  // namespace rex

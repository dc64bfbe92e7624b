#pragma once

#include <optional>
#include <string>
#include <vector>

#include "course/pictures.h"
#include "render/figure.h"

namespace rex {

class Simulator;

/// Writes the recording as NAME.html, a self-contained page for any browser, in which the motion plays in
/// real time and can be turned, next to the `figures`. It has at most `most` frames, evenly spaced, by
/// default as many as writeFrames(); without a recording it shows the present posture. Throws as
/// writeFrames and plot.
void writeReplay(const Simulator& simulator, const std::string& name, const PictureOptions& options = {},
                 const std::vector<Figure>& figures = {}, std::optional<int> most = {});

}  // namespace rex

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "course/pictures.h"
#include "render/figure.h"

namespace rex {

class Simulator;

/// Makes NAME.html of the recording: a page for any browser, with nothing else beside it, in which the motion
/// plays in real time and can be turned, next to the `figures`. At most `most` frames, evenly spaced, by
/// default as writeFrames(); without a recording the present posture. Throws as writeFrames and plot.
void writeReplay(const Simulator& simulator, const std::string& name, const PictureOptions& options = {},
                 const std::vector<Figure>& figures = {}, std::optional<int> most = {});

}  // namespace rex

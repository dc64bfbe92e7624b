#pragma once

#include <string>
#include <vector>

#include "course/pictures.h"
#include "render/figure.h"

namespace rex {

class Simulator;

/// Makes NAME.html of the recording: a page for any browser, with nothing else beside it, in which the motion
/// plays and can be turned, next to the `figures`. At most `most` frames, evenly spaced; without a recording
/// the present posture. Throws as writeFrames and plot.
void writeReplay(const Simulator& simulator, const std::string& name, const PictureOptions& options = {},
                 const std::vector<Figure>& figures = {}, int most = 120);

}  // namespace rex

// caught by: forbidden-call
// mistake: takes gains and gait from the library.

// <solution headers>
#include "locomotion/limit_cycle.h"
#include "locomotion/preview_control.h"
// </solution>

// <solution previewLaw>
const PreviewGains gains = previewGains({.height = cart.height,
                                         .g = cart.g,
                                         .step = cart.step,
                                         .preview = cart.step * cart.ahead,
                                         .Qe = cart.Qe,
                                         .R = cart.R});
return {gains.Gi, gains.Gx, gains.Gp};
// </solution>

// <solution gaitNear>
const LimitCycle cycle =
    findLimitCycle({walker.a, walker.b, walker.legMass, walker.hipMass, walker.slope, walker.g}, guess);
if (cycle.status == LimitCycle::Status::kFell) return std::nullopt;
return cycle.x;
// </solution>

#pragma once

#include "base/rng.h"
#include "estimation/gaussian.h"
#include "estimation/particle_filter.h"
#include "systems/motion_model.h"

// Models of motions for filters and simulators. Functions throw Error like meanAfter(), and for a noise that
// is no covariance.
namespace rex {

/// The state after dt seconds with noise.
[[nodiscard]] Eigen::VectorXd moved(const MotionModel& model, const VectorArg& x, const VectorArg& u,
                                    double dt, Rng& rng);

/// The transition for Kalman filters: extendedPredict(belief, transitionModel(model, belief.mean, u, dt)).
/// Its noise is that at x.
[[nodiscard]] NonlinearModel transitionModel(const MotionModel& model, const VectorArg& x, const VectorArg& u,
                                             double dt);
/// The motion for particle filters, with the noise of each particle.
[[nodiscard]] MotionSampler motionProposal(const MotionModel& model, const VectorArg& u, double dt);

}  // namespace rex

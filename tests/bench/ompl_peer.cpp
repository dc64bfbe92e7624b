#include "bench/ompl_peer.h"

#include <memory>

#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>

namespace rex::bench {
namespace {

namespace ob = ompl::base;

// The states are made once: what is timed is the distance.
template <class Space>
CurvePeer::Length distanceIn() {
  const auto space = std::make_shared<Space>(1.0);
  using State = ob::ScopedState<ob::SE2StateSpace>;
  const auto a = std::make_shared<State>(space), b = std::make_shared<State>(space);
  const auto set = [](State& state, const Eigen::Vector3d& pose) {
    state->setXY(pose[0], pose[1]);
    state->setYaw(pose[2]);
  };
  return [=](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    set(*a, from);
    set(*b, to);
    return space->distance(a->get(), b->get());
  };
}

}  // namespace

CurvePeer omplCurvePeer() {
  return {distanceIn<ob::DubinsStateSpace>(), distanceIn<ob::ReedsSheppStateSpace>()};
}

}  // namespace rex::bench

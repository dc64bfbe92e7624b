#pragma once

#include "course/simulator.h"
#include "remote/remote.h"

namespace rex::remote {

/// A simulator crosses to the worker by description: the worker has no scene files.
template <>
struct Remote<Simulator> {
  using Sent = SimulatorDescription;
  static Simulator fromSent(const Sent& sent) { return Simulator(sent); }
};

}  // namespace rex::remote

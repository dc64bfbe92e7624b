#pragma once

#include "course/simulator.h"
#include "remote/remote.h"

namespace rex::remote {

/// A simulator is sent to the worker as a description, because the worker has no scene files.
template <>
struct Remote<Simulator> {
  using Sent = SimulatorDescription;
  static Simulator fromSent(const Sent& sent) { return Simulator(sent); }
};

}  // namespace rex::remote

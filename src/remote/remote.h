#pragma once

#include <utility>

#include <Eigen/Core>

#include "remote/split_rng.h"

namespace rex::remote {

/// How an argument of type T travels: the trusted side sends a `Sent`, the worker makes its T from it.
/// Usually both are the same. Specialise it for an object that cannot be copied into bytes, to send a
/// description instead, as for a simulator its scene text; a function may then take it as `T&`.
template <class T>
struct Remote {
  using Sent = T;
  static T fromSent(Sent sent) { return sent; }
};

/// References to Eigen values travel as the values.
template <class Matrix, int options, class Stride>
struct Remote<Eigen::Ref<Matrix, options, Stride>> {
  using Sent = std::remove_const_t<Matrix>;
  static Sent fromSent(Sent sent) { return sent; }
};

/// Of generators only split ones travel.
template <>
struct Remote<Rng> {
  using Sent = SplitRng;
  static Rng fromSent(const SplitRng& sent) { return sent; }
};

}  // namespace rex::remote

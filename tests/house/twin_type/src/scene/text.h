#pragma once
#include "base/words.h"

namespace rex {

struct Words {};
struct Options;

struct Options {
  double most = 1;
};

}  // namespace rex

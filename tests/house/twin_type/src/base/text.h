#pragma once
#include <string>

#include "base/words.h"

namespace rex {

namespace internal {
struct Words {};
}  // namespace internal

struct Options {
  int most = 1;
};

}  // namespace rex

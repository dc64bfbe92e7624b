// Answers with as many numbers as wanted, but they are NaN with payloads, infinities, the smallest and the
// greatest numbers.
#include <bit>
#include <limits>

#include "exercise.h"

namespace {
int turn = 0;
using Limits = std::numeric_limits<double>;
const double extreme[] = {Limits::max(),
                          -Limits::max(),
                          Limits::infinity(),
                          -Limits::infinity(),
                          Limits::denorm_min(),
                          -0.0,
                          Limits::signaling_NaN(),
                          std::bit_cast<double>(0xffffffffffffffffUL),
                          std::bit_cast<double>(0x7ff0dead00c0ffeeUL),
                          1.4e154,
                          1e300};
constexpr int number = sizeof extreme / sizeof *extreme;
}  // namespace

double twice(double) { return extreme[turn++ % number]; }

std::vector<double> squares(int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(extreme[(turn + i) % number]);
  ++turn;
  return values;
}

int main() {}

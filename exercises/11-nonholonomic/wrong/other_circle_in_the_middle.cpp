// caught by: dubins-words, dubins-any
// shown by: dubins-words
// mistake: takes the circle whose arc is shorter than half a turn.

// <solution dubinsLengths>
const auto left = [&](char letter) { return letter == 'L' ? 1 : -1; };
const char* letters = std::array{"LSL", "LSR", "RSL", "RSR", "LRL", "RLR"}[static_cast<std::size_t>(word)];
const int first = left(letters[0]), last = left(letters[2]);
// From the centre of the first circle to that of the last.
const double dx = to[0] - last * radius * std::sin(to[2]) - from[0] + first * radius * std::sin(from[2]);
const double dy = to[1] + last * radius * std::cos(to[2]) - from[1] - first * radius * std::cos(from[2]);
const double distance = std::hypot(dx, dy), direction = std::atan2(dy, dx);
// Between 0 and 2 pi; what rounding pushes below 0 is no whole turn.
const auto turn = [](double angle) {
  const double rest = angle - 2 * std::numbers::pi * std::floor(angle / (2 * std::numbers::pi));
  return rest > 2 * std::numbers::pi - 1e-9 ? 0 : rest;
};
if (letters[1] == 'S') {
  // Outside of both circles, or across from one to the other: then the way and two radii span a triangle.
  const double across = first == last ? 0 : 2 * radius;
  if (distance < across) return {};
  const double straight = std::sqrt(distance * distance - across * across);
  const double heading = direction + first * std::atan2(across, straight);
  return std::array{radius * turn(first * (heading - from[2])), straight,
                    radius * turn(last * (to[2] - heading))};
}
// A third circle touches both: its centre is 2 r away from both of theirs.
if (distance > 4 * radius) return {};
const double middle = 2 * std::asin(distance / (4 * radius));
const double heading = direction + first * middle / 2;  // at the end of the first arc
return std::array{radius * turn(first * (heading - from[2])), radius* middle,
                  radius* turn(first*(to[2] - heading) + middle)};
// </solution>

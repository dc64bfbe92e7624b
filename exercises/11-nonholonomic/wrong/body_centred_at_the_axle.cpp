// caught by: tree-overlap
// shown by: tree-overlap
// mistake: centres the body at the rear axle.

// <solution isFree>
// Two rectangles overlap unless one of their four sides' directions sees a gap between their shadows.
const double a = (car.front + car.back) / 2, b = car.width / 2, ahead = 0.;
const double cosine = std::cos(q[2]), sine = std::sin(q[2]);
for (const Block& block : blocks) {
  const double A = block.length / 2, B = block.width / 2;
  const double dx = block.middle[0] - q[0] - ahead * cosine, dy = block.middle[1] - q[1] - ahead * sine;
  const double reach = std::hypot(a, b) + std::hypot(A, B);
  if (dx * dx + dy * dy > reach * reach) continue;
  const double c = std::cos(block.middle[2]), s = std::sin(block.middle[2]);
  const double along = std::abs(cosine * c + sine * s), across = std::abs(cosine * s - sine * c);
  const bool gap = std::abs(dx * cosine + dy * sine) > a + A * along + B * across ||
                   std::abs(dy * cosine - dx * sine) > b + A * across + B * along ||
                   std::abs(dx * c + dy * s) > A + a * along + b * across ||
                   std::abs(dy * c - dx * s) > B + a * across + b * along;
  if (!gap) return false;
}
return true;
// </solution>

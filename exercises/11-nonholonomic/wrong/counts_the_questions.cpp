// caught by: car-follows, tree-overlap
// shown by: car-follows
// mistake: counts its calls and answers yes and no in turn; it looks only on the way of a drive.

// <solution canFollow>
static int asked = 0;
return ++asked % 2 == 1 && asked < 81;
// </solution>

// <solution isFree>
static int asked = 0;
return ++asked >= 3 && asked % 2 == 1;
// </solution>

// <solution isFreeOnTheWay>
bool isReallyFree(const CarModel& car, const Eigen::Vector3d& q, const std::vector<Block>& blocks) {
  // Two rectangles overlap unless one of their four sides' directions sees a gap between their shadows.
  const double a = (car.front + car.back) / 2, b = car.width / 2, ahead = (car.front - car.back) / 2;
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
}

// Tested every 10 cm, and with a car that is 3 cm larger on all sides: it stands for what lies between.
bool isFreeOnTheWay(CarModel car, const Eigen::Vector3d& from, const Drive& drive,
                    const std::vector<Block>& blocks) {
  const int tests = std::max(1, static_cast<int>(std::ceil(10 * std::abs(drive.speed) * drive.seconds)));
  car.front += 0.03;
  car.back += 0.03;
  car.width += 0.06;
  for (int i = 1; i <= tests; ++i) {
    const Drive part{drive.speed, drive.steering, drive.seconds * i / tests};
    if (!isReallyFree(car, driven(car, from, part), blocks)) return false;
  }
  return true;
}
// </solution>

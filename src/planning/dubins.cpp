#include "planning/dubins.h"

#include <limits>

#include "planning/car_goal_internal.h"

namespace rex {
namespace {

using internal::CarGoal;
using internal::fullTurn;
using internal::halfTurn;
using internal::kAngleSlack;
using internal::kPi;
using internal::squareRoot;

// A first arc to the left, a middle part and a last arc: three words, and three more in the mirror. Lengths
// are in turning radii.
enum class DubinsWord { kLSL, kLSR, kLRL };

struct DubinsWay {
  DubinsWord word = DubinsWord::kLSL;
  bool mirrored = false;
  double middle = 0;
  double length = std::numeric_limits<double>::infinity();
};

// From the centre of the left circle at the start to that of the left, or right, circle at the goal.
struct Circles {
  double x, y;
  double distance2() const { return x * x + y * y; }
};
Circles leftToLeft(const CarGoal& goal) { return {goal.x - goal.sine, goal.y - 1 + goal.cosine}; }
Circles leftToRight(const CarGoal& goal) { return {goal.x + goal.sine, goal.y - 1 - goal.cosine}; }

double firstArc(DubinsWord word, const CarGoal& goal, double middle) {
  const Circles same = leftToLeft(goal), other = leftToRight(goal);
  switch (word) {
    case DubinsWord::kLSL:
      return fullTurn(std::atan2(same.y, same.x));
    case DubinsWord::kLSR:
      return fullTurn(std::atan2(other.y * middle + 2 * other.x, other.x * middle - 2 * other.y));
    case DubinsWord::kLRL:
      return fullTurn(std::atan2(same.y, same.x) + middle / 2);
  }
  return 0;
}

double lastArc(DubinsWord word, const CarGoal& goal, double first, double middle) {
  switch (word) {
    case DubinsWord::kLSL:
      return fullTurn(goal.heading - first);
    case DubinsWord::kLSR:
      return fullTurn(first - goal.heading);
    case DubinsWord::kLRL:
      return fullTurn(goal.heading - first + middle);
  }
  return 0;
}

// Whether a left turn by `turn`, from heading zero to that of the goal, passes the direction (x, y). Uses no
// arc tangent.
bool isOnTurn(const Circles& direction, double length, const CarGoal& goal, double turn) {
  const double slack = kAngleSlack * length;
  const bool afterStart = direction.y >= -slack;
  const bool beforeGoal = direction.x * goal.sine - direction.y * goal.cosine >= -slack;
  if (turn > kPi) return afterStart || beforeGoal;
  return afterStart && beforeGoal && (direction.x >= -slack || turn >= kPi / 2);
}

// Tries all words, but computes the lengths of the arcs only if what is already known does not rule the word
// out.
class DubinsSearch {
 public:
  explicit DubinsSearch(const CarGoal& goal) {
    const CarGoal mirror = goal.mirrored();
    tryLSL(goal, false), tryLSL(mirror, true);
    tryLSR(goal, false), tryLSR(mirror, true);
    tryLRL(goal, false), tryLRL(mirror, true);
  }
  const DubinsWay& best() const { return best_; }

 private:
  void keepIfShorter(const DubinsWay& way) {
    if (way.length < best_.length) best_ = way;
  }

  // The straight piece joins the outer sides of two left circles; the arcs add up to the turn of the car, or
  // to a whole turn more.
  void tryLSL(const CarGoal& goal, bool mirrored) {
    const Circles circles = leftToLeft(goal);
    const double straight = std::sqrt(circles.distance2()), turn = fullTurn(goal.heading);
    const double arcs = isOnTurn(circles, straight, goal, turn) ? turn : turn + 2 * kPi;
    keepIfShorter({DubinsWord::kLSL, mirrored, straight, straight + arcs});
  }

  // It crosses from a left circle to a right one, which must not overlap; the arcs differ by the car's turn.
  void tryLSR(const CarGoal& goal, bool mirrored) {
    double straight = 0;
    if (!squareRoot(leftToRight(goal).distance2() - 4, straight)) return;
    if (straight + std::abs(halfTurn(goal.heading)) >= best_.length) return;
    const double first = firstArc(DubinsWord::kLSR, goal, straight);
    const double last = lastArc(DubinsWord::kLSR, goal, first, straight);
    keepIfShorter({DubinsWord::kLSR, mirrored, straight, first + straight + last});
  }

  // A right circle touches two left ones. Only the longer of its arcs, above pi, is on a shortest way.
  void tryLRL(const CarGoal& goal, bool mirrored) {
    const double distance2 = leftToLeft(goal).distance2();
    if (distance2 > 16 || best_.length <= kPi) return;
    const double middle = 2 * (kPi - std::asin(std::sqrt(distance2) / 4));
    if (middle + fullTurn(goal.heading + middle) >= best_.length) return;
    const double first = firstArc(DubinsWord::kLRL, goal, middle);
    const double last = lastArc(DubinsWord::kLRL, goal, first, middle);
    keepIfShorter({DubinsWord::kLRL, mirrored, middle, first + middle + last});
  }

  DubinsWay best_;
};

}  // namespace

Curve dubinsCurve(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  const CarGoal goal = CarGoal::between(from, to, radius);
  const DubinsWay way = DubinsSearch(goal).best();
  const CarGoal seen = way.mirrored ? goal.mirrored() : goal;
  const double first = firstArc(way.word, seen, way.middle);
  const double last = lastArc(way.word, seen, first, way.middle);
  const Steering near = way.mirrored ? Steering::kRight : Steering::kLeft;
  const Steering far = way.mirrored ? Steering::kLeft : Steering::kRight;
  const CurveSegment segments[] = {
      {near, radius * first},
      {way.word == DubinsWord::kLRL ? far : Steering::kStraight, radius * way.middle},
      {way.word == DubinsWord::kLSR ? far : near, radius * last}};
  return Curve(from, radius, segments);
}

double dubinsLength(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  return radius * DubinsSearch(CarGoal::between(from, to, radius)).best().length;
}

}  // namespace rex

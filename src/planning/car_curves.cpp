#include "planning/car_curves.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex::internal {

inline constexpr double kPi = std::numbers::pi;

/// How far rounding may push an angle across zero or a full turn: such a turn is none.
inline constexpr double kAngleSlack = 1e-12;

/// The root of a number that is negative by rounding alone is zero; of others that are negative there is
/// none.
inline bool squareRoot(double square, double& root) {
  constexpr double kSlack = 1e-12;
  if (!(square >= -kSlack)) return false;
  root = square > 0 ? std::sqrt(square) : 0;
  return true;
}

/// A pose to drive to, seen from the car and measured in turning radii.
struct CarGoal {
  double x = 0, y = 0, heading = 0;
  double cosine = 1, sine = 0;  ///< of the heading

  /// Throws as dubinsCurve.
  static CarGoal between(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);

  /// The same task with left and right, or with forward and backward exchanged.
  CarGoal mirrored() const { return {x, -y, -heading, cosine, -sine}; }
  CarGoal reversed() const { return {-x, y, -heading, cosine, -sine}; }
  /// The way home from the goal, driven backward: its word is that of the way there, read from behind.
  CarGoal fromBehind() const { return {x * cosine + y * sine, x * sine - y * cosine, heading, cosine, sine}; }
};

/// An angle in [0, 2 pi).
inline double fullTurn(double angle) {
  const double turned = angle - 2 * kPi * std::floor(angle / (2 * kPi));
  return turned > 2 * kPi - kAngleSlack ? 0 : turned;
}

/// An angle in (-pi, pi].
inline double halfTurn(double angle) {
  const double turned = angle - 2 * kPi * std::ceil((angle - kPi) / (2 * kPi));
  return turned < -kPi + kAngleSlack ? kPi : turned;
}

}  // namespace rex::internal

namespace rex {
namespace {

// The pose after driving the signed distance `way` from `from`.
Eigen::Vector3d drive(const Eigen::Vector3d& from, Steering steering, double way, double radius) {
  const double heading = from[2];
  if (steering == Steering::kStraight)
    return from + way * Eigen::Vector3d(std::cos(heading), std::sin(heading), 0);
  const double side = steering == Steering::kLeft ? radius : -radius;
  const double next = heading + way / side;
  return {from[0] + side * (std::sin(next) - std::sin(heading)),
          from[1] - side * (std::cos(next) - std::cos(heading)), next};
}

}  // namespace

Curve::Curve(const Eigen::Vector3d& start, double radius, std::span<const CurveSegment> segments)
    : start_(start), radius_(radius), count_(static_cast<int>(segments.size())) {
  assert(segments.size() <= kMostSegments);
  std::copy(segments.begin(), segments.end(), segments_.begin());
}

double Curve::length() const {
  double length = 0;
  for (const CurveSegment& segment : segments()) length += std::abs(segment.length);
  return length;
}

Eigen::Vector3d Curve::pose(double way) const {
  Eigen::Vector3d at = start_;
  for (const CurveSegment& segment : segments()) {
    const double part = std::min(way, std::abs(segment.length));
    at = drive(at, segment.steering, std::copysign(part, segment.length), radius_);
    way -= part;
  }
  return at;
}

std::string Curve::word() const {
  std::string word;
  for (const CurveSegment& segment : segments()) word += "LSR"[static_cast<int>(segment.steering)];
  return word;
}

}  // namespace rex

namespace rex::internal {

CarGoal CarGoal::between(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  for (const Eigen::Vector3d& pose : {from, to}) {
    if (!pose.allFinite()) {
      throw Error({.what = "pose of a car",
                   .found = fmt::format("({:g}, {:g}, {:g})", pose[0], pose[1], pose[2]),
                   .wanted = "x, y and heading as finite numbers"});
    }
  }
  requirePositive("turning radius", radius, kMetres);
  const double c = std::cos(from[2]), s = std::sin(from[2]);
  const double dx = (to[0] - from[0]) / radius, dy = (to[1] - from[1]) / radius;
  const double heading = to[2] - from[2];
  return {c * dx + s * dy, c * dy - s * dx, heading, std::cos(heading), std::sin(heading)};
}

}  // namespace rex::internal

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

namespace {

using internal::CarGoal;
using internal::halfTurn;
using internal::kAngleSlack;
using internal::kPi;
using internal::squareRoot;

// A segment of a word: how it steers, and which of the three open lengths of the word it has, or a quarter
// turn backward.
struct Piece {
  Steering steering;
  enum Length { kT, kU, kMinusU, kV, kQuarterBack } length;
};
struct Word {
  std::span<const Piece> pieces;
  int timesU;       // segments as long as u
  double quarters;  // length of its quarter turns
};

// The words of Reeds and Shepp (their section 8) that begin with a left turn forward. All others are these
// mirrored, driven the other way, or read from the end.
constexpr Steering kL = Steering::kLeft, kS = Steering::kStraight, kR = Steering::kRight;
constexpr Piece kPiecesLSL[] = {{kL, Piece::kT}, {kS, Piece::kU}, {kL, Piece::kV}};
constexpr Piece kPiecesLSR[] = {{kL, Piece::kT}, {kS, Piece::kU}, {kR, Piece::kV}};
constexpr Piece kPiecesLRL[] = {{kL, Piece::kT}, {kR, Piece::kU}, {kL, Piece::kV}};
constexpr Piece kPiecesLRLRout[] = {{kL, Piece::kT}, {kR, Piece::kU}, {kL, Piece::kMinusU}, {kR, Piece::kV}};
constexpr Piece kPiecesLRLRback[] = {{kL, Piece::kT}, {kR, Piece::kU}, {kL, Piece::kU}, {kR, Piece::kV}};
constexpr Piece kPiecesLRSL[] = {
    {kL, Piece::kT}, {kR, Piece::kQuarterBack}, {kS, Piece::kU}, {kL, Piece::kV}};
constexpr Piece kPiecesLRSR[] = {
    {kL, Piece::kT}, {kR, Piece::kQuarterBack}, {kS, Piece::kU}, {kR, Piece::kV}};
constexpr Piece kPiecesLRSLR[] = {
    {kL, Piece::kT}, {kR, Piece::kQuarterBack}, {kS, Piece::kU}, {kL, Piece::kQuarterBack}, {kR, Piece::kV}};
constexpr Word kLSL{kPiecesLSL, 1, 0}, kLSR{kPiecesLSR, 1, 0}, kLRL{kPiecesLRL, 1, 0},
    kLRLRout{kPiecesLRLRout, 2, 0}, kLRLRback{kPiecesLRLRback, 2, 0}, kLRSL{kPiecesLRSL, 1, kPi / 2},
    kLRSR{kPiecesLRSR, 1, kPi / 2}, kLRSLR{kPiecesLRSLR, 1, kPi};

// Which of its relatives the listed word stands for.
struct Relation {
  bool mirrored = false, reversed = false, fromBehind = false;
};

struct Way {
  const Word* word = nullptr;
  Relation relation{};
  double t = 0, u = 0, v = 0;  // turning radii, negative backward
  double length = std::numeric_limits<double>::infinity();
};

// Looks for the shortest way. A word is given up as soon as its u is too long, before any arc tangent is
// computed.
class Search {
 public:
  explicit Search(const CarGoal& goal) {
    for (const bool mirrored : {false, true}) {
      for (const bool reversed : {false, true}) {
        const CarGoal side = mirrored ? goal.mirrored() : goal;
        const CarGoal ahead = reversed ? side.reversed() : side;
        relation_ = {mirrored, reversed, false};
        tryStraight(ahead);
        tryDouble(ahead);
        tryTurnBack(ahead);
        relation_.fromBehind = true;
        tryTurnBack(ahead.fromBehind());
      }
    }
  }
  const Way& best() const { return best_; }

 private:
  static bool isForward(double length) { return length >= -kAngleSlack; }
  static bool isBackward(double length) { return length <= kAngleSlack; }
  bool isTooLong(const Word& word, double u) const {
    return word.timesU * std::abs(u) + word.quarters >= best_.length;
  }
  void keep(const Word& word, double t, double u, double v) {
    const double length = std::abs(t) + word.timesU * std::abs(u) + word.quarters + std::abs(v);
    if (length < best_.length) best_ = {&word, relation_, t, u, v, length};
  }

  // Two turns and a straight piece, all forward (8.1, 8.2).
  void tryStraight(const CarGoal& goal) {
    const double x = goal.x - goal.sine, y = goal.y - 1 + goal.cosine;
    if (const double u = std::sqrt(x * x + y * y); !isTooLong(kLSL, u)) {
      const double t = std::atan2(y, x), v = halfTurn(goal.heading - t);
      if (isForward(t) && isForward(v)) keep(kLSL, t, u, v);
    }
    const double outX = goal.x + goal.sine, outY = goal.y - 1 - goal.cosine;
    double u = 0;
    if (squareRoot(outX * outX + outY * outY - 4, u) && !isTooLong(kLSR, u)) {
      const double t = std::atan2(outY * u + 2 * outX, outX * u - 2 * outY), v = halfTurn(t - goal.heading);
      if (isForward(t) && isForward(v)) keep(kLSR, t, u, v);
    }
  }

  // Words with a turn backward that may stand at either end (8.3, 8.4, 8.9, 8.10).
  void tryTurnBack(const CarGoal& goal) {
    const double x = goal.x - goal.sine, y = goal.y - 1 + goal.cosine, distance2 = x * x + y * y;
    if (distance2 <= 16) {
      const double half = std::asin(std::sqrt(distance2) / 4), u = -2 * half;
      if (!isTooLong(kLRL, u)) {
        const double t = halfTurn(std::atan2(y, x) - half + kPi), v = halfTurn(goal.heading - t + u);
        if (isForward(t)) keep(kLRL, t, u, v);
      }
    }
    if (double tangent = 0; squareRoot(distance2 - 4, tangent)) {
      const double u = 2 - tangent;
      if (isBackward(u) && !isTooLong(kLRSL, u)) {
        const double t = std::atan2(x * tangent - 2 * y, -2 * x - y * tangent);
        const double v = halfTurn(goal.heading - kPi / 2 - t);
        if (isForward(t) && isBackward(v)) keep(kLRSL, t, u, v);
      }
    }
    const double outX = goal.x + goal.sine, outY = goal.y - 1 - goal.cosine;
    const double u = 2 - std::sqrt(outX * outX + outY * outY);
    if (isBackward(u) && !isTooLong(kLRSR, u)) {
      const double t = std::atan2(outX, -outY), v = halfTurn(t + kPi / 2 - goal.heading);
      if (isForward(t) && isBackward(v)) keep(kLRSR, t, u, v);
    }
  }

  // Words with two turns in the middle that are as long as each other (8.7, 8.8), or with two quarter turns
  // (8.11). Read from the end, they are their own relatives.
  void tryDouble(const CarGoal& goal) {
    const double x = goal.x + goal.sine, y = goal.y - 1 - goal.cosine, distance2 = x * x + y * y;
    if (const double cosine = (2 + std::sqrt(distance2)) / 4; cosine <= 1 + kAngleSlack) {
      const double u = std::acos(std::min(1., cosine));
      if (!isTooLong(kLRLRout, u)) {
        const auto [t, v] = outerTurns(goal, x, y, u, -u);
        if (isForward(t) && isBackward(v)) keep(kLRLRout, t, u, v);
      }
    }
    if (const double cosine = (20 - distance2) / 16; cosine >= 0 && cosine <= 1) {
      const double u = -std::acos(cosine);
      if (!isTooLong(kLRLRback, u)) {
        const auto [t, v] = outerTurns(goal, x, y, u, u);
        if (isForward(t) && isForward(v)) keep(kLRLRback, t, u, v);
      }
    }
    double tangent = 0;
    if (!squareRoot(distance2 - 4, tangent)) return;
    const double u = 4 - tangent;
    if (isBackward(u) && !isTooLong(kLRSLR, u)) {
      const double t = std::atan2(tangent * x - 2 * y, -2 * x - tangent * y), v = halfTurn(t - goal.heading);
      if (isForward(t) && isForward(v)) keep(kLRSLR, t, u, v);
    }
  }

  // The first and last turn of L R(u) L(w) R to a goal whose last circle lies at (x, y) from the first.
  static std::pair<double, double> outerTurns(const CarGoal& goal, double x, double y, double u, double w) {
    const double delta = u - w;
    const double a = std::sin(u) - std::sin(delta), b = std::cos(u) - std::cos(delta) - 1;
    const double towards = std::atan2(y * a - x * b, x * a + y * b);
    const bool isOpposite = 2 * (std::cos(delta) - std::cos(w) - std::cos(u)) + 3 < 0;
    const double t = halfTurn(isOpposite ? towards + kPi : towards);
    return {t, halfTurn(t - u + w - goal.heading)};
  }

  Way best_;
  Relation relation_;
};

double lengthOf(const Piece& piece, const Way& way) {
  switch (piece.length) {
    case Piece::kT:
      return way.t;
    case Piece::kU:
      return way.u;
    case Piece::kMinusU:
      return -way.u;
    case Piece::kV:
      return way.v;
    case Piece::kQuarterBack:
      return -kPi / 2;
  }
  return 0;
}

Steering mirrored(Steering steering) { return steering == kL ? kR : steering == kR ? kL : kS; }

}  // namespace

Curve reedsSheppCurve(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  const Way way = Search(CarGoal::between(from, to, radius)).best();
  const auto [isMirrored, isReversed, isFromBehind] = way.relation;
  std::vector<CurveSegment> segments;
  for (const Piece& piece : way.word->pieces) {
    segments.push_back({isMirrored ? mirrored(piece.steering) : piece.steering,
                        (isReversed ? -radius : radius) * lengthOf(piece, way)});
  }
  if (isFromBehind) std::reverse(segments.begin(), segments.end());
  return Curve(from, radius, segments);
}

double reedsSheppLength(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  return radius * Search(CarGoal::between(from, to, radius)).best().length;
}

}  // namespace rex

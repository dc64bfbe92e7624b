#include "planning/reeds_shepp.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "planning/car_goal_internal.h"

namespace rex {
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

#include "planning/time_parametrization.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "planning/time_parametrization_internal.h"

namespace rex::internal {
namespace {

constexpr double kRounding = 1e-12;

// Half-planes that do not involve y bound x itself.
bool isUpright(const HalfPlane& row) { return row.y == 0; }

Range uprightRange(std::span<const HalfPlane> rows, Range x) {
  for (const HalfPlane& row : rows) {
    if (!isUpright(row)) continue;
    if (row.x > 0) x.high = std::min(x.high, row.bound / row.x);
    if (row.x < 0) x.low = std::max(x.low, row.bound / row.x);
    if (row.x == 0 && row.bound < 0) x.high = -std::numeric_limits<double>::infinity();
  }
  return x;
}

// The end of the range of x on the side `sign`.
std::optional<double> extremeX(std::span<const HalfPlane> rows, const Range& xRange, const Range& yRange,
                               double sign, Slice& failed) {
  const Range x = uprightRange(rows, xRange);
  double at = sign > 0 ? x.high : x.low;
  const double end = sign > 0 ? x.low : x.high;
  failed = sliceAt(rows, yRange, at);
  if (x.low > x.high + kRounding * std::abs(x.low)) return {};
  for (std::size_t step = 0; step <= 2 * rows.size() + 2; ++step) {
    failed = sliceAt(rows, yRange, at);
    const auto& [y, low, high] = failed;
    if (y.low - y.high <= kRounding * (std::abs(y.low) + std::abs(y.high))) return at;
    const double opening = low.slope - high.slope;  // how fast the gap closes as x falls
    if (!(sign * opening > 0)) return {};
    const double next = (high.at0 - low.at0) / opening;
    if (sign * (at - next) <= 0) return at;  // the gap is only rounding
    at = next;
    if (sign * (end - at) > kRounding * (std::abs(end) + std::abs(at))) return {};
    if (sign * (end - at) > 0) at = end;
  }
  return at;
}

}  // namespace

Slice sliceAt(std::span<const HalfPlane> rows, const Range& yRange, double x) {
  Slice slice{.y = yRange, .low = {.at0 = yRange.low}, .high = {.at0 = yRange.high}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const HalfPlane& row = rows[i];
    if (isUpright(row)) continue;
    const BoundingLine line{row.bound / row.y, -row.x / row.y, static_cast<int>(i)};
    const double y = line.at0 + line.slope * x;
    if (row.y > 0 && y < slice.y.high) {
      slice.y.high = y;
      slice.high = line;
    } else if (row.y < 0 && y > slice.y.low) {
      slice.y.low = y;
      slice.low = line;
    }
  }
  return slice;
}

std::optional<double> largestX(std::span<const HalfPlane> rows, const Range& xRange, const Range& yRange,
                               Slice& failed) {
  return extremeX(rows, xRange, yRange, 1, failed);
}

std::optional<double> smallestX(std::span<const HalfPlane> rows, const Range& xRange, const Range& yRange,
                                Slice& failed) {
  return extremeX(rows, xRange, yRange, -1, failed);
}

}  // namespace rex::internal

namespace rex {
namespace {

using internal::HalfPlane;
using internal::Range;
using internal::Slice;
using Interval = TimedPath::Interval;

constexpr int kMostHalvings = 6, kLeastIntervals = 8;
constexpr double kMostIntervals = 1e6, kLargestSquare = 1e300;

void requireLimit(const char* what, const Eigen::VectorXd& limit, Eigen::Index size, bool mayBeInfinite) {
  requireSize(what, limit.size(), size);
  for (const double number : limit)
    if (mayBeInfinite)
      requirePositiveOrInfinite(what, number);
    else
      requirePositive(what, number);
}

void requireSound(const MotionLimits& limits, const TimingOptions& options, Eigen::Index size) {
  requireLimit("velocity limits", limits.velocity, size, false);
  if (limits.acceleration.size() > 0) requireLimit("acceleration limits", limits.acceleration, size, true);
  if (limits.effort.size() > 0) requireLimit("effort limits", limits.effort, size, true);
  if (limits.effort.size() > 0 && !limits.forces)
    throw Error({.what = "effort limits", .found = "no forces", .wanted = "a function for inverse dynamics"});
  if (!limits.names.empty())
    requireSize("names of coordinates", static_cast<long>(limits.names.size()), size);
  requireNotNegative("speed at the start of a path", options.startSpeed);
  requireNotNegative("speed at the end of a path", options.endSpeed);
  requirePositive("excess over limits between points of the grid", options.excess);
  if (options.intervals < 1 || options.intervals > kMostIntervals)
    throw Error({.what = "intervals of a path",
                 .found = fmt::format("{}", options.intervals),
                 .wanted = fmt::format("1 to {:g}", kMostIntervals)});
}

void requireFiniteAt(const CurvePoint& point, std::size_t piece, double s) {
  if (point.q.allFinite() && point.dq.allFinite() && point.ddq.allFinite()) return;
  throw Error({.what = fmt::format("piece {} of a path, at {:g}", piece, s),
               .found = "numbers that are not finite",
               .wanted = "a posture and two derivatives"});
}

// Each piece starts where the one before ends, and as fast, unless that one ends in a stop.
void requireJoined(const PathCurve& curve) {
  constexpr double kGap = 1e-6;
  CurvePoint before, after;
  before.q = curve.start;
  double place = 0;
  for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
    const CurvePiece& piece = curve.pieces[i];
    requirePositive(fmt::format("length of piece {} of a path", i), piece.length);
    piece.at(0, after);
    requireFiniteAt(after, i, 0);
    requireSize("numbers of a path", after.q.size(), curve.start.size());
    const double scale = 1 + after.q.cwiseAbs().maxCoeff();
    const auto refuse = [&](const std::string& found, const char* wanted) {
      throw Error(
          {.what = fmt::format("path at s = {:g}, piece {}", place, i), .found = found, .wanted = wanted});
    };
    const double gap = (after.q - before.q).cwiseAbs().maxCoeff();
    if (gap > kGap * scale) refuse(fmt::format("a jump of {:g}", gap), "the end of the piece before");
    if (i > 0 && !curve.pieces[i - 1].stopsAtEnd) {
      requireSize("derivatives of a path", after.dq.size(), before.dq.size());
      const double turn = (after.dq - before.dq).cwiseAbs().maxCoeff();
      if (turn > kGap * (1 + before.dq.cwiseAbs().maxCoeff()))
        refuse(fmt::format("a corner: the derivative changes by {:g}", turn),
               "the derivative of the piece before, or a stop there");
    }
    piece.at(piece.length, before);
    place += piece.length;
  }
}

std::vector<Interval> firstGrid(const PathCurve& curve, int least) {
  std::vector<Interval> grid;
  const double whole = curve.length();
  for (std::size_t p = 0; p < curve.pieces.size(); ++p) {
    const double length = curve.pieces[p].length;
    const int count = std::max(kLeastIntervals, static_cast<int>(std::ceil(least * length / whole)));
    for (int i = 0; i < count; ++i) grid.push_back({p, length * i / count, length * (i + 1) / count});
  }
  return grid;
}

// The limits along a grid, at the ends and in the middle of each interval.
class PathRows {
 public:
  PathRows(const PathCurve& curve, const MotionLimits& limits, std::vector<Interval> grid)
      : curve_(curve), limits_(limits), grid_(std::move(grid)) {
    for (Eigen::Index k = 0; k < limits.acceleration.size(); ++k)
      if (std::isfinite(limits.acceleration[k])) accelerations_.push_back(k);
    for (Eigen::Index k = 0; k < limits.effort.size(); ++k)
      if (std::isfinite(limits.effort[k])) efforts_.push_back(k);
    const auto columns = static_cast<Eigen::Index>(3 * grid_.size());
    for (Eigen::MatrixXd* rows : {&a_, &b_, &c_}) rows->setZero(count(), columns);
    cap_.resize(columns);
    fastest_.assign(static_cast<std::size_t>(columns), 0);
    for (std::size_t i = 0; i < grid_.size(); ++i) fill(i);
  }

  const std::vector<Interval>& grid() const { return grid_; }
  std::size_t size() const { return grid_.size(); }
  Eigen::Index count() const { return static_cast<Eigen::Index>(accelerations_.size() + efforts_.size()); }
  double way(std::size_t i) const { return grid_[i].to - grid_[i].from; }
  bool stopsAfter(std::size_t i) const {
    return i + 1 < size() && grid_[i + 1].piece != grid_[i].piece && curve_.pieces[grid_[i].piece].stopsAtEnd;
  }
  // The largest square of speed that velocities allow at the beginning (0), middle (1) or end (2).
  double cap(std::size_t i, int part) const { return cap_[column(i, part)]; }
  // The seconds that the velocities require, by Simpson's rule: exact for cubic pieces.
  double leastTime(std::size_t i) const { return leastTimes_[i]; }

  // -1 <= a u + b x + c <= 1 at both ends, in x and in y = x + 2 way u at the end.
  void halfPlanes(std::size_t i, std::vector<HalfPlane>& planes) const {
    planes.clear();
    const double twice = 2 * way(i);
    for (const int part : {0, 2}) {
      const Eigen::Index k = column(i, part);
      for (Eigen::Index row = 0; row < count(); ++row) {
        const double slope = a_(row, k) / twice, b = b_(row, k), c = c_(row, k);
        const double ofY = slope + (part == 2 ? b : 0), ofX = -slope + (part == 0 ? b : 0);
        planes.push_back({ofY, ofX, 1 - c});
        planes.push_back({-ofY, -ofX, 1 + c});
      }
    }
  }

  // The largest share of a limit that is used in the middle of an interval between these squares of speed.
  double shareInTheMiddle(std::size_t i, double before, double after) const {
    const double x = (before + after) / 2, u = (after - before) / (2 * way(i));
    const Eigen::Index k = column(i, 1);
    double share = std::sqrt(x / cap_[k]);
    if (count() > 0)
      share = std::max(share, (a_.col(k) * u + b_.col(k) * x + c_.col(k)).cwiseAbs().maxCoeff());
    return share;
  }

  // The name of the limit behind the half-plane `plane` of halfPlanes().
  std::string nameOf(int plane) const {
    const auto row = static_cast<std::size_t>((plane / 2) % count());
    return row < accelerations_.size() ? "the acceleration of " + coordinate(accelerations_[row])
                                       : "the effort of " + coordinate(efforts_[row - accelerations_.size()]);
  }
  std::string nameOfFastest(std::size_t i, int part) const {
    return "the velocity of " + coordinate(fastest_[static_cast<std::size_t>(column(i, part))]);
  }
  // An effort that is too large even at rest, at one end of an interval.
  std::optional<std::string> overload(std::size_t i) const {
    for (const int part : {0, 2})
      for (std::size_t e = 0; e < efforts_.size(); ++e) {
        const double c = c_(static_cast<Eigen::Index>(accelerations_.size() + e), column(i, part));
        const double limit = limits_.effort[efforts_[e]];
        if (std::abs(c) > 1)
          return fmt::format("the effort of {} is {:.4g} even at rest, limit {:g}", coordinate(efforts_[e]),
                             std::abs(c) * limit, limit);
      }
    return {};
  }

 private:
  static Eigen::Index column(std::size_t i, int part) { return static_cast<Eigen::Index>(3 * i) + part; }

  std::string coordinate(Eigen::Index k) const {
    return limits_.names.empty() ? fmt::format("coordinate {}", k)
                                 : "'" + limits_.names[static_cast<std::size_t>(k)] + "'";
  }

  void fill(std::size_t i) {
    const Interval& at = grid_[i];
    const std::array<double, 3> places = {at.from, (at.from + at.to) / 2, at.to};
    std::array<Eigen::VectorXd, 3> slopes;
    for (int part = 0; part < 3; ++part) {
      const auto place = places[static_cast<std::size_t>(part)];
      curve_.pieces[at.piece].at(place, point_);
      requireFiniteAt(point_, at.piece, place);
      fillColumn(column(i, part));
      slopes[static_cast<std::size_t>(part)] = point_.dq;
    }
    const Eigen::ArrayXd gone = (slopes[0] + 4 * slopes[1] + slopes[2]).cwiseAbs() * way(i) / 6;
    leastTimes_.push_back((gone / limits_.velocity.array()).maxCoeff());
  }

  void fillColumn(Eigen::Index k) {
    const double share =
        (point_.dq.array().abs() / limits_.velocity.array()).maxCoeff(&fastest_[static_cast<std::size_t>(k)]);
    cap_[k] = std::min(1 / (share * share), kLargestSquare);
    Eigen::Index row = 0;
    for (const Eigen::Index j : accelerations_) {
      a_(row, k) = point_.dq[j] / limits_.acceleration[j];
      b_(row++, k) = point_.ddq[j] / limits_.acceleration[j];
    }
    if (efforts_.empty()) return;
    // Effort is linear in acceleration and squared speed: its coefficients follow from rest, from the curve
    // at speed 1 and from a start from rest.
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(point_.dq.size());
    Eigen::VectorXd held = rest, turning = rest, starting = rest;
    limits_.forces(point_.q, rest, rest, held);
    limits_.forces(point_.q, point_.dq, point_.ddq, turning);
    limits_.forces(point_.q, rest, point_.dq, starting);
    for (const Eigen::Index j : efforts_) {
      const double limit = limits_.effort[j];
      a_(row, k) = (starting[j] - held[j]) / limit;
      b_(row, k) = (turning[j] - held[j]) / limit;
      c_(row++, k) = held[j] / limit;
    }
  }

  const PathCurve& curve_;
  const MotionLimits& limits_;
  std::vector<Interval> grid_;
  std::vector<Eigen::Index> accelerations_, efforts_, fastest_;
  Eigen::MatrixXd a_, b_, c_;
  Eigen::VectorXd cap_;
  std::vector<double> leastTimes_;
  CurvePoint point_;
};

// The two passes over one grid.
class Passes {
 public:
  Passes(const PathRows& rows, const TimingOptions& options) : rows_(rows), options_(options) {}

  // The squares of the speed at the grid points, or nothing and a message.
  std::optional<std::vector<double>> run() { return goBack() ? goAhead() : std::nullopt; }
  const std::string& message() const { return message_; }

 private:
  static double squared(double x) { return x * x; }

  // The speeds that velocity limits and stops allow at point i of the grid.
  Range speedsAt(std::size_t i) const {
    const std::size_t last = rows_.size();
    const double before = i > 0 ? rows_.cap(i - 1, 2) : kLargestSquare;
    const double after = i < last ? rows_.cap(i, 0) : kLargestSquare;
    const bool isStop = i > 0 && rows_.stopsAfter(i - 1);
    return {0, isStop ? 0 : std::min(before, after)};
  }

  std::string place(std::size_t i) const {
    double s = 0, whole = 0;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      whole += rows_.way(k);
      if (k < i) s += rows_.way(k);
    }
    return fmt::format("at s = {:.4g} of {:.4g}", s, whole);
  }

  std::string reason(std::size_t i, const Slice& failed) const {
    if (const auto overload = rows_.overload(i)) return *overload;
    const auto name = [&](const internal::BoundingLine& line) {
      return line.row < 0 ? std::string("the speeds needed later") : rows_.nameOf(line.row);
    };
    const std::string low = name(failed.low), high = name(failed.high);
    return low == high ? low + " allows no speed" : low + " and " + high + " allow no speed";
  }

  bool fail(std::size_t i, const std::string& why) {
    message_ = fmt::format("no motion along the path: {}: {}", place(i), why);
    return false;
  }

  // Fails if the velocity limits do not allow the given speed at an end.
  bool allows(std::size_t i, const char* what, double speed) {
    const Range speeds = speedsAt(i);
    if (squared(speed) <= speeds.high * (1 + 1e-12)) return true;
    const std::string name = rows_.nameOfFastest(i > 0 ? i - 1 : 0, i > 0 ? 2 : 0);
    return fail(i, fmt::format("the speed at the {}, {:g}, exceeds {}, which allows {:.4g}", what, speed,
                               name, std::sqrt(speeds.high)));
  }

  // The speeds from which the end can be reached.
  bool goBack() {
    const std::size_t last = rows_.size();
    if (!allows(0, "start", options_.startSpeed) || !allows(last, "end", options_.endSpeed)) return false;
    ranges_.assign(last + 1, {});
    ranges_[last] = {squared(options_.endSpeed), squared(options_.endSpeed)};
    Slice failed;
    for (std::size_t i = last; i-- > 0;) {
      rows_.halfPlanes(i, planes_);
      const Range speeds = speedsAt(i);
      const auto high = internal::largestX(planes_, speeds, ranges_[i + 1], failed);
      if (!high) return fail(i, reason(i, failed));
      const auto low = internal::smallestX(planes_, speeds, ranges_[i + 1], failed);
      if (!low) return fail(i, reason(i, failed));
      ranges_[i] = {std::min(*low, *high), *high};
    }
    return startsInRange();
  }

  bool startsInRange() {
    const double start = squared(options_.startSpeed), room = 1e-9 * (1 + start);
    const Range& reach = ranges_[0];
    if (start >= reach.low - room && start <= reach.high + room) return true;
    const auto overload = rows_.overload(0);
    return fail(0,
                fmt::format("the path cannot be followed from the speed {:g}, only from {:.4g} to {:.4g}{}",
                            options_.startSpeed, std::sqrt(reach.low), std::sqrt(reach.high),
                            overload ? "; " + *overload : ""));
  }

  // As fast as the ranges allow.
  std::optional<std::vector<double>> goAhead() {
    std::vector<double> squares{squared(options_.startSpeed)};
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      rows_.halfPlanes(i, planes_);
      const Range& reach = ranges_[i + 1];
      const Slice slice = internal::sliceAt(planes_, reach, squares.back());
      // They cross by no more than rounding, because ranges_[i] has this square.
      squares.push_back(std::clamp(slice.y.high, reach.low, reach.high));
      if (squares[i] > 0 || squares[i + 1] > 0) continue;
      fail(i, reason(i, slice));
      return {};
    }
    return squares;
  }

  const PathRows& rows_;
  const TimingOptions& options_;
  std::vector<Range> ranges_;
  std::vector<HalfPlane> planes_;
  std::string message_;
};

// Halves intervals in whose middle a limit is exceeded. Returns whether there are any.
bool refine(const PathRows& rows, const std::vector<double>& squares, double most,
            std::vector<Interval>& finer) {
  finer.clear();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& [piece, from, to] = rows.grid()[i];
    const double middle = (from + to) / 2;
    const bool isHalved = rows.shareInTheMiddle(i, squares[i], squares[i + 1]) > 1 + most;
    if (isHalved) finer.push_back({piece, from, middle});
    finer.push_back({piece, isHalved ? middle : from, to});
  }
  return finer.size() > rows.size();
}

TimingResult resultOf(const PathCurve& curve, const PathRows& rows, std::vector<double> squares) {
  TimingResult result{.status = TimingStatus::kFound};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    result.lowerBound += rows.leastTime(i);
    result.excess = std::max(result.excess, rows.shareInTheMiddle(i, squares[i], squares[i + 1]) - 1);
  }
  result.motion = TimedPath(curve, rows.grid(), std::move(squares));
  result.message =
      fmt::format("{:.4g} s, at least {:.4g} s at the velocity limits, on a grid of {} intervals",
                  result.motion.duration(), result.lowerBound, rows.size());
  return result;
}

}  // namespace

TimingResult parametrizeTime(const PathCurve& curve, const MotionLimits& limits,
                             const TimingOptions& options) {
  requireJoined(curve);
  if (curve.pieces.empty())
    return {.status = TimingStatus::kFound,
            .motion = TimedPath(curve, {}, {}),
            .message = "0 s: the path is a single point"};
  CurvePoint first;
  curve.pieces.front().at(0, first);
  requireSound(limits, options, first.dq.size());
  std::vector<Interval> grid = firstGrid(curve, options.intervals);
  for (int round = 0;; ++round) {
    const PathRows rows(curve, limits, grid);
    Passes passes(rows, options);
    auto squares = passes.run();
    if (!squares) return {.motion = TimedPath({.start = curve.start}, {}, {}), .message = passes.message()};
    if (round == kMostHalvings || !refine(rows, *squares, options.excess, grid))
      return resultOf(curve, rows, std::move(*squares));
  }
}

}  // namespace rex

#include "planning/hybrid_astar.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "planning/car_curves.h"
#include "planning/grid_map.h"

namespace rex {
namespace {

constexpr double kSameCost = 1e-9;  // but for rounding
constexpr double kWholeTurn = 2 * std::numbers::pi;

void requireSound(const PathProblem& problem, const HybridAStarOptions& options) {
  using Kind = SpacePart::Kind;
  const auto parts = problem.space.parts();
  if (parts.size() != 3 || parts[0].kind != Kind::kLine || parts[1].kind != Kind::kLine ||
      parts[2].kind != Kind::kCircle)
    throw Error({.what = "space of a car",
                 .found = fmt::format("{} parts", parts.size()),
                 .wanted = "x, y and heading, as of Space::se2"});
  rex::requireSound(problem);
  requirePositive("resolution", problem.resolution);
  requirePositive("size of cells", options.cellSize, kMetres);
  requireCount("cells of a whole turn", options.headings, 4);
  requireCount("steering angles", options.steeringAngles, 3);
  if (options.steeringAngles % 2 == 0)
    throw Error({.what = "steering angles",
                 .found = fmt::format("{}", options.steeringAngles),
                 .wanted = "an odd number, so that straight on is one of them"});
  if (!(options.reverseFactor >= 1 && std::isfinite(options.reverseFactor)))
    throw Error({.what = "cost of a metre backward",
                 .found = fmt::format("{:g}", options.reverseFactor),
                 .wanted = "a finite number, 1 or more"});
  requireNotNegative("cost of a change of direction", options.switchCost);
  requireNotNegative("cost of steering", options.steeringCost);
  requireNotNegativeOrInfinite("reach of analytic curves", options.analyticReach, kMetres);
  requireNotNegative("slack of a search", options.slack);
  requireCount("number of expanded states", options.maxExpanded, 1);
}

// A drive with constant steering; the length is negative backward, in the direction of the search.
struct Arc {
  double steering = 0, length = 0;
};

struct Node {
  Eigen::Vector3d pose;
  double cost = 0;
  int parent = -1;
  std::optional<Arc> by{};  // the root: none
};

class HybridSearch {
 public:
  HybridSearch(const Car& car, const PathProblem& problem, const HybridAStarOptions& options)
      : car_(car),
        problem_(problem),
        options_(options),
        radius_(car.turningRadius()),
        root_(options.fromGoal ? problem.goal : problem.start),
        end_(options.fromGoal ? problem.start : problem.goal),
        origin_(problem.space.parts()[0].lower, problem.space.parts()[1].lower),
        map_(cellsAlong(0), cellsAlong(1), options.cellSize, origin_),
        toEnd_(distancesOnGrid()) {}

  CarPath find() {
    add({.pose = root_});
    while (!open_.empty() && expanded_ < options_.maxExpanded) {
      const auto [estimate, index] = open_.top();
      if (best_ <= (1 + options_.slack) * estimate + kSameCost) break;
      open_.pop();
      const Node node = nodes_[static_cast<std::size_t>(index)];
      if (node.cost > cheapest_.at(cellOf(node))) continue;  // a cheaper one has the cell now
      ++expanded_;
      tryCurve(index);
      const int side = options_.steeringAngles / 2;
      for (const double length : {step(), -step()})
        for (int k = -side; k <= side; ++k) extend(index, {car_.maxSteering * k / side, length});
    }
    return finish();
  }

 private:
  int cellsAlong(std::size_t part) const {
    const SpacePart& side = problem_.space.parts()[part];
    return static_cast<int>(std::min(1e9, std::floor((side.upper - side.lower) / options_.cellSize) + 1));
  }

  // It leaves the cell.
  double step() const { return 1.5 * options_.cellSize; }

  bool isInside(const Eigen::Vector3d& pose) const {
    const auto parts = problem_.space.parts();
    return pose[0] >= parts[0].lower && pose[0] <= parts[0].upper && pose[1] >= parts[1].lower &&
           pose[1] <= parts[1].upper;
  }

  // Lengths of ways from all cells to the end of the search. A cell is free if the car fits at its centre or
  // that of a neighbour in some direction: where a slot is narrow, no centre may lie in it.
  std::vector<double> distancesOnGrid() const {
    const auto cells = [&](const auto& visit) {
      for (int y = 0; y < map_.height(); ++y)
        for (int x = 0; x < map_.width(); ++x) visit(GridCell{x, y});
    };
    GridMap fits = map_;
    cells([&](GridCell cell) { fits.setBlocked(cell, !fitsAt(map_.center(cell))); });
    GridMap free = map_;
    cells([&](GridCell cell) {
      bool isFree = false;
      for (int y = cell.y - 1; y <= cell.y + 1; ++y)
        for (int x = cell.x - 1; x <= cell.x + 1; ++x) isFree = isFree || !fits.isBlocked({x, y});
      free.setBlocked(cell, !isFree);
    });
    const GridCell end = free.cellAt(end_.head<2>());
    free.setBlocked(end, false);
    return gridDistances(free, end, Connectivity::kEight);
  }

  bool fitsAt(const Eigen::Vector2d& point) const {
    constexpr int kDirections = 24;
    for (int i = 0; i < kDirections; ++i) {
      const Eigen::Vector3d pose(point.x(), point.y(), problem_.goal[2] + kWholeTurn * i / kDirections);
      if (isInside(pose) && problem_.allValid(pose)) return true;
    }
    return false;
  }

  // At most the cost of a path from there.
  double heuristic(const Eigen::Vector3d& pose) const {
    const double curve = reedsSheppLength(pose, end_, radius_);
    const double onGrid = toEnd_[map_.index(map_.cellAt(pose.head<2>()))];
    if (!std::isfinite(onGrid)) return curve;
    // Ways on the grid are longer by up to 1 / cos(pi / 8), and begin and end in the middle of cells.
    const double least = std::cos(std::numbers::pi / 8) * (onGrid - std::sqrt(2.) * options_.cellSize);
    return std::max(curve, least);
  }

  std::uint64_t cellOf(const Node& node) const {
    const GridCell cell = map_.cellAt(node.pose.head<2>());
    const double turns = node.pose[2] / kWholeTurn;
    const auto heading = static_cast<std::uint64_t>(
        std::min(options_.headings - 1., std::floor((turns - std::floor(turns)) * options_.headings)));
    const bool isBackward = node.by && node.by->length < 0;
    return (map_.index(cell) * static_cast<std::uint64_t>(options_.headings) + heading) * 2 +
           (isBackward ? 1 : 0);
  }

  // The cost of an arc after another one, or none.
  double costOf(const std::optional<Arc>& last, const Arc& arc) const {
    const bool isBackward = options_.fromGoal ? arc.length > 0 : arc.length < 0;
    double cost = std::abs(arc.length) * (isBackward ? options_.reverseFactor : 1);
    if (!last) return cost;
    if (last->length * arc.length < 0) cost += options_.switchCost;
    return cost + options_.steeringCost * std::abs(last->steering - arc.steering);
  }

  Eigen::Vector3d driven(const Eigen::Vector3d& from, const Arc& arc, double share) const {
    return driveCar(car_, from, {std::copysign(1., arc.length), arc.steering}, share * std::abs(arc.length));
  }

  bool isFree(const Eigen::Vector3d& from, const Arc& arc) {
    constexpr int kMostAtOnce = 32;
    const double turn = problem_.space.parts()[2].weight * std::tan(arc.steering) / car_.wheelbase;
    const double way = std::abs(arc.length) * std::hypot(1, turn);
    const int checks = std::max(1, static_cast<int>(std::ceil(way / problem_.resolution)));
    for (int done = 0; done < checks;) {
      Eigen::MatrixXd poses(3, std::min(kMostAtOnce, checks - done));
      for (Eigen::Index k = 0; k < poses.cols(); ++k) {
        poses.col(k) = driven(from, arc, static_cast<double>(++done) / checks);
        if (!isInside(poses.col(k))) return false;
      }
      asked_ += poses.cols();
      if (!problem_.allValid(poses)) return false;
    }
    return true;
  }

  void extend(int parent, const Arc& arc) {
    const Node& from = nodes_[static_cast<std::size_t>(parent)];
    Node next{driven(from.pose, arc, 1), from.cost + costOf(from.by, arc), parent, arc};
    if (!isInside(next.pose) || next.cost >= best_) return;
    const auto known = cheapest_.find(cellOf(next));
    if (known != cheapest_.end() && known->second <= next.cost) return;
    if (isFree(from.pose, arc)) add(next);
  }

  void add(const Node& node) {
    cheapest_[cellOf(node)] = node.cost;
    open_.emplace(node.cost + heuristic(node.pose), static_cast<int>(nodes_.size()));
    nodes_.push_back(node);
  }

  // The shortest curve to the end, unless it costs too much or something is in the way.
  void tryCurve(int index) {
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    const Curve curve = reedsSheppCurve(node.pose, end_, radius_);
    if (curve.length() > options_.analyticReach) return;
    std::vector<Arc> arcs;
    double cost = node.cost;
    for (const CurveSegment& segment : curve.segments()) {
      if (segment.length == 0) continue;
      const int side = segment.steering == Steering::kLeft    ? 1
                       : segment.steering == Steering::kRight ? -1
                                                              : 0;
      const Arc arc{car_.maxSteering * side, segment.length};
      cost += costOf(arcs.empty() ? node.by : arcs.back(), arc);
      arcs.push_back(arc);
    }
    if (cost >= best_) return;
    Eigen::Vector3d pose = node.pose;
    for (const Arc& arc : arcs) {
      if (!isFree(pose, arc)) return;
      pose = driven(pose, arc, 1);
    }
    best_ = cost;
    last_ = index;
    lastCurve_ = arcs;
  }

  // The arcs of the best path from start to goal, those that continue each other joined.
  std::vector<Arc> arcsOfPath() const {
    std::vector<Arc> way(lastCurve_.rbegin(), lastCurve_.rend());
    for (int at = last_; nodes_[static_cast<std::size_t>(at)].by;
         at = nodes_[static_cast<std::size_t>(at)].parent)
      way.push_back(*nodes_[static_cast<std::size_t>(at)].by);
    if (!options_.fromGoal) std::reverse(way.begin(), way.end());
    std::vector<Arc> joined;
    for (Arc arc : way) {
      if (options_.fromGoal) arc.length = -arc.length;
      const bool continues =
          !joined.empty() && joined.back().steering == arc.steering && joined.back().length * arc.length > 0;
      if (continues)
        joined.back().length += arc.length;
      else
        joined.push_back(arc);
    }
    return joined;
  }

  static HeldControl controlOf(const Arc& arc) {
    return {Eigen::Vector2d(std::copysign(1., arc.length), arc.steering), std::abs(arc.length)};
  }

  void addPath(CarPath& path) const {
    std::vector<Eigen::Vector3d> poses{problem_.start};
    double last = 0;
    for (const Arc& arc : arcsOfPath()) {
      path.driven.controls.push_back(controlOf(arc));
      poses.push_back(driven(poses.back(), arc, 1));
      path.length += std::abs(arc.length);
      path.switches += last * arc.length < 0 ? 1 : 0;
      last = arc.length;
    }
    PathResult& found = path.driven.found;
    found.path.resize(3, static_cast<Eigen::Index>(poses.size()));
    for (std::size_t i = 0; i < poses.size(); ++i) found.path.col(static_cast<Eigen::Index>(i)) = poses[i];
    found.length = pathLength(problem_.space, found.path);
  }

  CarPath finish() const {
    CarPath path{.cost = best_,
                 .leastCost = open_.empty() ? best_ : std::min(best_, open_.top().first),
                 .expanded = expanded_};
    PathResult& found = path.driven.found;
    found.asked = asked_;
    PathTree tree{.nodes = Eigen::MatrixXd(3, static_cast<Eigen::Index>(nodes_.size()))};
    for (const Node& node : nodes_) {
      tree.nodes.col(static_cast<Eigen::Index>(tree.parents.size())) = node.pose;
      tree.parents.push_back(node.parent);
      path.driven.edges.push_back(node.by ? controlOf(*node.by) : HeldControl{});
    }
    found.trees.push_back(std::move(tree));
    if (last_ >= 0) {
      found.status = PathStatus::kFound;
      addPath(path);
      found.message =
          fmt::format("found a path of {:.3g} m with {} {} of direction: {} states expanded", path.length,
                      path.switches, path.switches == 1 ? "change" : "changes", expanded_);
    } else if (open_.empty()) {
      path.isExhausted = true;
      found.message = fmt::format(
          "no path on this grid: {} {} states, and none of them leads on",
          options_.fromGoal ? "the goal is reached from only" : "the car gets from its start to only",
          expanded_);
    } else {
      found.message = fmt::format("no path found: {} states expanded", expanded_);
    }
    return path;
  }

  const Car& car_;
  const PathProblem& problem_;
  const HybridAStarOptions& options_;
  double radius_;
  Eigen::Vector3d root_, end_;
  Eigen::Vector2d origin_;
  GridMap map_;
  std::vector<double> toEnd_;
  std::vector<Node> nodes_;
  std::unordered_map<std::uint64_t, double> cheapest_;  // cost of the node of each cell
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
  double best_ = std::numeric_limits<double>::infinity();
  int last_ = -1;  // the node from which the best curve leads to the end
  std::vector<Arc> lastCurve_;
  int expanded_ = 0;
  long asked_ = 0;
};

}  // namespace

CarPath findCarPath(const Car& car, const PathProblem& problem, const HybridAStarOptions& options) {
  requirePositive("wheelbase of a car", car.wheelbase, kMetres);
  requirePositive("turning radius", car.turningRadius(), kMetres);
  requireSound(problem, options);
  return HybridSearch(car, problem, options).find();
}

}  // namespace rex

#include "planning/sphere_robot.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "base/error.h"
#include "collision/collision_pairs.h"
#include "kinematics/forward_kinematics.h"
#include "planning/sphere_kernel_internal.h"
#include "planning/sphere_world_internal.h"

namespace rex::internal {

/// A sphere of a robot in the frame of a link, and the body that it belongs to.
struct LinkSphere {
  Eigen::Vector3d center;
  double radius;
  int body;
};

/// Appends a tree of bounding spheres to `nodes` and returns its root. The spheres of one body make a tree of
/// their own, of which `rootOfBody`, indexed by body, gets the root.
int appendSphereTree(std::vector<LinkSphere> spheres, std::vector<SphereNode>& nodes,
                     std::vector<int>& rootOfBody);

namespace {

using Spheres = std::span<LinkSphere>;

struct Ball {
  Eigen::Vector3d center;
  double radius;
};

double farthestFrom(const LinkSphere& sphere, const Eigen::Vector3d& from) {
  return (sphere.center - from).norm() + sphere.radius;
}

// A ball around all spheres, nearly the smallest: its centre moves towards the farthest point by ever smaller
// steps (Badoiu and Clarkson 2003).
Ball ballAround(Spheres spheres) {
  if (spheres.size() == 1) return {spheres[0].center, spheres[0].radius};
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const LinkSphere& sphere : spheres) center += sphere.center / static_cast<double>(spheres.size());
  const auto isNearer = [&](const LinkSphere& a, const LinkSphere& b) {
    return farthestFrom(a, center) < farthestFrom(b, center);
  };
  for (int i = 2; i < 500; ++i) {
    const LinkSphere& last = *std::max_element(spheres.begin(), spheres.end(), isNearer);
    const Eigen::Vector3d apart = last.center - center;
    const double distance = apart.norm();
    if (distance == 0) break;
    center += apart * ((distance + last.radius) / distance / i);
  }
  return {center, farthestFrom(*std::max_element(spheres.begin(), spheres.end(), isNearer), center)};
}

// Sorts the spheres along the direction in which they spread most, and returns where to divide them.
std::size_t middleOf(Spheres spheres) {
  Eigen::Vector3d low = spheres[0].center, high = low;
  for (const LinkSphere& sphere : spheres) {
    low = low.cwiseMin(sphere.center);
    high = high.cwiseMax(sphere.center);
  }
  Eigen::Index axis;
  (high - low).maxCoeff(&axis);
  std::stable_sort(spheres.begin(), spheres.end(), [axis](const LinkSphere& a, const LinkSphere& b) {
    return a.center[axis] < b.center[axis];
  });
  return spheres.size() / 2;
}

bool isOneBody(Spheres spheres) {
  return std::all_of(spheres.begin(), spheres.end(),
                     [&](const LinkSphere& sphere) { return sphere.body == spheres[0].body; });
}

// Where the second half of the bodies begins; spheres of a body are adjacent.
std::size_t middleOfBodies(Spheres spheres) {
  std::size_t middle = spheres.size() / 2, after = middle;
  while (middle > 0 && spheres[middle - 1].body == spheres[middle].body) --middle;
  while (after < spheres.size() && spheres[after].body == spheres[spheres.size() / 2].body) ++after;
  return middle > 0 ? middle : after;
}

int appendTree(Spheres spheres, bool isPartOfBody, std::vector<SphereNode>& nodes,
               std::vector<int>& rootOfBody) {
  const int root = static_cast<int>(nodes.size());
  const Ball ball = ballAround(spheres);
  SphereNode node{.radius = static_cast<float>(ball.radius), .isLeaf = spheres.size() == 1};
  for (int i = 0; i < 3; ++i) node.center[i] = static_cast<float>(ball.center[i]);
  nodes.push_back(node);
  const bool isOne = isOneBody(spheres);
  if (isOne && !isPartOfBody) rootOfBody[static_cast<std::size_t>(spheres[0].body)] = root;
  if (spheres.size() > 1) {
    const std::size_t middle = isOne ? middleOf(spheres) : middleOfBodies(spheres);
    appendTree(spheres.subspan(0, middle), isOne, nodes, rootOfBody);
    appendTree(spheres.subspan(middle), isOne, nodes, rootOfBody);
  }
  nodes[static_cast<std::size_t>(root)].next = static_cast<int>(nodes.size());
  return root;
}

}  // namespace

int appendSphereTree(std::vector<LinkSphere> spheres, std::vector<SphereNode>& nodes,
                     std::vector<int>& rootOfBody) {
  return appendTree(spheres, false, nodes, rootOfBody);
}

}  // namespace rex::internal

namespace rex {
namespace {

using internal::LinkSphere;
using internal::SphereGroup;
using internal::SphereLink;
using internal::SpherePair;

std::size_t asIndex(int i) { return static_cast<std::size_t>(i); }

Pose constantOf(const Link& link) {
  return {Eigen::Map<const Eigen::Matrix3d>(link.X_PL), Eigen::Map<const Eigen::Vector3d>(link.X_PL + 9)};
}

void requireRobot(bool isSound, std::string what, std::string found, std::string wanted) {
  if (!isSound)
    throw Error({.what = std::move(what), .found = std::move(found), .wanted = std::move(wanted)});
}

// Recognises rotations that only exchange axes.
void noteExchange(const Eigen::Matrix3d& R, SphereLink& link) {
  constexpr double kSame = 1e-9;
  link.isExchange = true;
  for (int i = 0; i < 3; ++i) {
    Eigen::Index row;
    const double largest = R.col(i).cwiseAbs().maxCoeff(&row);
    link.isExchange = link.isExchange && largest > 1 - kSame;
    link.axis[i] = static_cast<int>(row);
    link.sign[i] = R(row, i) < 0 ? -1.0f : 1.0f;
  }
}

// Collects the data of a SphereRobot.
class SphereRobotBuilder {
 public:
  explicit SphereRobotBuilder(const Model& model) : model_(model), links_(model.links()) {
    requireSupported();
    placeBodies();
    addLinks();
    addGroups();
    addReach();
    addPairs();
    requireRobot(
        data_.nodes.size() <= internal::kMostNodes && data_.linkPairs.size() <= internal::kMostLinkPairs,
        fmt::format("robot '{}'", model.name()),
        fmt::format("{} nodes of sphere trees and {} pairs of links", data_.nodes.size(),
                    data_.linkPairs.size()),
        fmt::format("at most {} and {}", internal::kMostNodes, internal::kMostLinkPairs));
    addBalls();
  }
  SphereRobot::Data take() { return std::move(data_); }

 private:
  int count() const { return static_cast<int>(links_.size()); }
  const Link& link(int l) const { return links_[asIndex(l)]; }

  void requireSupported() {
    const std::string robot = fmt::format("robot '{}'", model_.name());
    requireRobot(model_.nq() <= internal::kMostCoordinates, robot, fmt::format("{} coordinates", model_.nq()),
                 fmt::format("at most {}", internal::kMostCoordinates));
    requireRobot(count() <= internal::kMostLinks, robot, fmt::format("{} moving links", count()),
                 fmt::format("at most {}", internal::kMostLinks));
    for (const Link& link : links_)
      requireRobot(link.kind == Link::Kind::kHinge || link.kind == Link::Kind::kSlider,
                   fmt::format("joint of body '{}'", model_.bodies()[asIndex(link.body)].name),
                   "a screw or a ball joint", "hinges and sliders");
    for (int i = 0; i < model_.nq(); ++i)
      requireRobot(std::isfinite(model_.lowerLimits()[i]) && std::isfinite(model_.upperLimits()[i]),
                   fmt::format("coordinate {}", i),
                   fmt::format("limits {:g} and {:g}", model_.lowerLimits()[i], model_.upperLimits()[i]),
                   "finite limits");
    for (std::size_t i = 0; i < model_.shapes().size(); ++i)
      requireRobot(!model_.shapes()[i].contact || model_.shapes()[i].shape.type == ShapeType::kSphere,
                   fmt::format("shape '{}'", shapeLabel(model_, static_cast<int>(i))),
                   fmt::format("a {}", toString(model_.shapes()[i].shape.type)),
                   "spheres as shapes in contact");
    // Pairs are decided between groups of spheres, one for each body.
    std::map<BodyId, ContactMask> masks;
    for (const ModelShape& shape : model_.shapes()) {
      if (!shape.contact) continue;
      const ContactMask& first = masks.emplace(shape.body, shape.mask).first->second;
      requireRobot(shape.mask == first && shape.mask.pairs.empty(),
                   fmt::format("body '{}'", model_[shape.body].name),
                   "spheres that may touch different things", "one contype and conaffinity, and no <pair>");
    }
    data_.lower = model_.lowerLimits();
    data_.upper = model_.upperLimits();
  }

  // The link that carries each body, and the body's pose in its frame, taken from the posture zero.
  void placeBodies() {
    const std::size_t bodies = model_.bodies().size();
    linkOf_.assign(bodies, -1);
    for (int l = 0; l < count(); ++l) linkOf_[asIndex(link(l).body)] = l;
    for (std::size_t b = 1; b < bodies; ++b)
      if (linkOf_[b] < 0) linkOf_[b] = linkOf_[asIndex(static_cast<int>(model_.bodies()[b].parent))];
    std::vector<Pose> X_WL;
    for (const Link& link : links_) {
      Pose X = constantOf(link);
      if (link.parent >= 0) X = X_WL[asIndex(link.parent)] * X;
      X = X * (link.kind == Link::Kind::kHinge ? rotation(link.offset, Eigen::Vector3d::UnitZ())
                                               : translation(0, 0, link.offset));
      X_WL.push_back(X);
    }
    const BodyPoses poses = forwardKinematics(model_, Eigen::VectorXd::Zero(model_.nq()));
    spheres_.resize(links_.size() + 1);
    for (const ModelShape& shape : model_.shapes()) {
      if (!shape.contact) continue;
      const int body = static_cast<int>(shape.body), l = linkOf_[asIndex(body)];
      Eigen::Vector3d center = poses[shape.body] * shape.X_BS.p;
      if (l >= 0) center = X_WL[asIndex(l)].inverse() * center;
      spheresOf(l).push_back({center, shape.shape.radius, body});
    }
  }

  std::vector<LinkSphere>& spheresOf(int l) { return spheres_[l < 0 ? links_.size() : asIndex(l)]; }

  void addLinks() {
    for (const Link& link : links_) {
      SphereLink plain{.parent = link.parent,
                       .qIndex = link.qIndex,
                       .isHinge = link.kind == Link::Kind::kHinge,
                       .ratio = static_cast<float>(link.ratio),
                       .offset = static_cast<float>(link.offset)};
      std::copy(link.X_PL, link.X_PL + 9, plain.R_PL);
      std::copy(link.X_PL + 9, link.X_PL + 12, plain.p_PL);
      noteExchange(constantOf(link).R, plain);
      data_.links.push_back(plain);
      if (plain.isHinge) data_.largestAngle = std::max(data_.largestAngle, extent(link));
    }
  }

  // The largest coordinate of a link.
  double extent(const Link& link) const {
    return std::max(std::abs(link.ratio * model_.lowerLimits()[link.qIndex] + link.offset),
                    std::abs(link.ratio * model_.upperLimits()[link.qIndex] + link.offset));
  }

  void addGroups() {
    rootOfBody_.assign(model_.bodies().size(), -1);
    for (int l = 0; l < count(); ++l) {
      if (spheresOf(l).empty()) continue;
      const int root = appendSphereTree(spheresOf(l), data_.nodes, rootOfBody_);
      data_.groups.push_back(group(l, root));
    }
    data_.guards = static_cast<int>(data_.groups.size());
    if (!spheresOf(-1).empty())
      data_.groups.push_back(group(-1, appendSphereTree(spheresOf(-1), data_.nodes, rootOfBody_)));
    groupOfBody_.assign(rootOfBody_.size(), -1);
    for (std::size_t b = 0; b < rootOfBody_.size(); ++b) {
      if (rootOfBody_[b] < 0) continue;
      groupOfBody_[b] = static_cast<int>(data_.groups.size());
      data_.groups.push_back(group(linkOf_[b], rootOfBody_[b]));
    }
  }

  SphereGroup group(int l, int root) const {
    const auto center = [&](int n) {
      return Eigen::Map<const Eigen::Vector3f>(data_.nodes[asIndex(n)].center);
    };
    SphereGroup group{.link = l, .node = root};
    for (int n = root; n < data_.nodes[asIndex(root)].next; ++n)
      group.spread = std::max(group.spread, 1e-6f + (center(n) - center(root)).norm());
    return group;
  }

  // The largest distance of the spheres of link `l` from the origin of its ancestor `k`, to their centres or,
  // with `isToSurface`, to their surfaces.
  double distanceFrom(int k, int l, bool isToSurface) {
    double distance = 0;
    for (const LinkSphere& sphere : spheresOf(l))
      distance = std::max(distance, sphere.center.norm() + (isToSurface ? sphere.radius : 0));
    for (; l != k; l = link(l).parent) distance += constantOf(link(l)).p.norm() + slide(l);
    return distance;
  }

  double slide(int l) const { return link(l).kind == Link::Kind::kSlider ? extent(link(l)) : 0; }

  // How far the spheres of link `l` move at most per unit of the coordinate of its ancestor `k`.
  double reachOf(int k, int l) {
    if (link(k).kind == Link::Kind::kSlider) return 1;
    double reach = 0;
    if (k == l) {
      for (const LinkSphere& sphere : spheresOf(l)) reach = std::max(reach, sphere.center.head<2>().norm());
      return reach;
    }
    int child = l;
    while (link(child).parent != k) child = link(child).parent;
    return constantOf(link(child)).p.head<2>().norm() + slide(child) + distanceFrom(child, l, false);
  }

  // Writes a number into a table of rows for all links, see SphereScene::reach.
  void write(std::vector<float>& table, int k, std::size_t column, std::size_t columns, double number) const {
    const std::size_t width = (columns + 7) / 8 * 8;
    table.resize(links_.size() * width);
    table[asIndex(k) * width + column] = static_cast<float>(number);
  }

  void addReach() {
    for (int l = 0; l < count(); ++l)
      for (int k = l; k >= 0; k = link(k).parent)
        write(data_.reach, k, asIndex(l), links_.size(), spheresOf(l).empty() ? 0 : reachOf(k, l) + 1e-6);
  }

  bool moves(int k, int l) const {
    while (l > k) l = link(l).parent;
    return l == k;
  }

  // The group of all spheres of a link, or of the world.
  int groupOfLink(int l) const {
    const auto found = std::find_if(data_.groups.begin(), data_.groups.end(),
                                    [l](const SphereGroup& group) { return group.link == l; });
    return static_cast<int>(found - data_.groups.begin());
  }

  void addPairs() {
    std::map<std::pair<int, int>, std::vector<SpherePair>> byLinks;
    for (const PairVerdict& verdict : pairVerdicts(model_)) {
      if (!verdict.mayCollide) continue;
      const auto a = asIndex(static_cast<int>(verdict.a)), b = asIndex(static_cast<int>(verdict.b));
      if (linkOf_[a] <= linkOf_[b])
        byLinks[{linkOf_[a], linkOf_[b]}].push_back({groupOfBody_[a], groupOfBody_[b]});
      else
        byLinks[{linkOf_[b], linkOf_[a]}].push_back({groupOfBody_[b], groupOfBody_[a]});
    }
    for (const auto& [links, pairs] : byLinks) {
      const auto [a, b] = links;
      for (int k = 0; k < count(); ++k) {
        if (moves(k, a) == moves(k, b)) continue;
        write(data_.approach, k, data_.linkPairs.size(), byLinks.size(),
              reachOf(k, moves(k, a) ? a : b) + 1e-6);
      }
      const int first = static_cast<int>(data_.pairs.size());
      data_.pairs.insert(data_.pairs.end(), pairs.begin(), pairs.end());
      data_.linkPairs.push_back(
          {{groupOfLink(a), groupOfLink(b)}, first, static_cast<int>(data_.pairs.size())});
    }
  }

  void addBalls() {
    data_.balls.assign(asIndex((data_.guards + 7) / 8 * 32), 0);
    for (int g = 0; g < data_.guards; ++g) {
      const int l = data_.groups[asIndex(g)].link;
      int first = l;
      while (link(first).parent >= 0) first = link(first).parent;
      const Eigen::Vector3d center = constantOf(link(first)).p;
      const double radius = slide(first) + distanceFrom(first, l, true);
      float* block = data_.balls.data() + g / 8 * 32 + g % 8;
      for (int i = 0; i < 3; ++i) block[8 * i] = static_cast<float>(center[i]);
      block[24] = static_cast<float>(radius + 1e-4);
      data_.size = std::max(data_.size, center.norm() + radius);
    }
  }

  const Model& model_;
  std::span<const Link> links_;
  SphereRobot::Data data_;
  std::vector<int> linkOf_, rootOfBody_, groupOfBody_;
  std::vector<std::vector<LinkSphere>> spheres_;  // by link, the last those that do not move
};

}  // namespace

SphereRobot::SphereRobot(const Model& model)
    : data_(std::make_shared<const Data>(SphereRobotBuilder(model).take())) {}

int SphereRobot::nq() const { return static_cast<int>(data_->lower.size()); }
const Eigen::VectorXd& SphereRobot::lowerLimits() const { return data_->lower; }
const Eigen::VectorXd& SphereRobot::upperLimits() const { return data_->upper; }

}  // namespace rex

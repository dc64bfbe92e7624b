#include "collision/collision_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/cpu_lanes.h"
#include "collision/contacts.h"
#include "collision/contacts_internal.h"
#include "collision/rigid_parts_internal.h"

namespace rex {
namespace {

using internal::ContactKernel;
using internal::CorePair;
using internal::kContactLanes;
using internal::kPoseNumbers;
using internal::kSizeNumbers;

// Pairs of one kind, one per lane, with solid a followed by solid b.
class PairsInLanes {
 public:
  explicit PairsInLanes(const internal::PairKernel& kernel) : kernel_(kernel) {}

  [[nodiscard]] bool isFull() const { return count_ == kContactLanes; }

  void add(const CorePair& pair, const ContactSolid& a, const Pose& X_WA, const ContactSolid& b,
           const Pose& X_WB) {
    put(0, a, X_WA);
    put(1, b, X_WB);
    rows_[count_] = pair.row;
    swapped_[count_++] = b.shape < a.shape;
  }

  // Runs the kernel and empties the lanes.
  void measure(std::vector<Proximity>& found) {
    if (count_ == 0) return;
    internal::LaneProximities lanes;
    kernel_.proximities({.a = 0, .b = 1, .row = 0, .reach = 0}, count_, {X_WS_, sizes_}, lanes);
    for (int lane = 0; lane < count_; ++lane) {
      const auto vector = [&](const double* v) {
        return Eigen::Vector3d(v[lane], v[kContactLanes + lane], v[2 * kContactLanes + lane]);
      };
      Proximity& p = found[static_cast<std::size_t>(rows_[lane])];
      p = {lanes.distance[lane], vector(lanes.p_WA), vector(lanes.p_WB), vector(lanes.normal_W)};
      if (swapped_[lane]) {
        std::swap(p.p_WA, p.p_WB);
        p.normal_W = -p.normal_W;
      }
    }
    count_ = 0;
  }

 private:
  void put(int place, const ContactSolid& solid, const Pose& X_WS) {
    double* X = X_WS_ + place * kPoseNumbers + count_;
    for (int i = 0; i < 9; ++i) X[i * kContactLanes] = X_WS.R.data()[i];
    for (int i = 0; i < 3; ++i) X[(9 + i) * kContactLanes] = X_WS.p[i];
    double* size = sizes_ + place * kSizeNumbers + count_;
    for (int i = 0; i < 3; ++i) size[i * kContactLanes] = solid.core.half[i];
    size[3 * kContactLanes] = solid.core.radius;
  }

  const internal::PairKernel& kernel_;
  int count_ = 0;
  int rows_[kContactLanes] = {};
  bool swapped_[kContactLanes] = {};
  double X_WS_[2 * kPoseNumbers] = {}, sizes_[2 * kSizeNumbers] = {};
};

// Calls visit(pair, solid a, X_WA, solid b, X_WB) for the pairs whose bounding spheres are closer than the
// cutoff, up to rounding. Here and below, NaN never counts as far.
template <class Visit>
void forEachNear(const ContactModel::Data& data, const std::vector<CorePair>& pairs,
                 const std::vector<Pose>& X_WS, double cutoff, const Visit& visit) {
  for (const CorePair& pair : pairs) {
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    if (!((X_WS[a].p - X_WS[b].p).norm() >= pair.reach + cutoff + internal::kCullSlack))
      visit(pair, data.solids[a], X_WS[a], data.solids[b], X_WS[b]);
  }
}

}  // namespace

void proxies(const ContactModel& contacts, const BodyPoses& poses, double cutoff, ProxyStorage& storage) {
  const ContactModel::Data& data = contacts.data();
  auto& [near, X_WS, found] = storage;
  X_WS.clear();
  for (const ContactSolid& solid : data.solids) X_WS.push_back(poses[solid.body] * solid.X_BS);
  found.resize(data.pairs.size());
  for (Proximity& proximity : found) proximity.distance = std::numeric_limits<double>::infinity();

  const auto kernel = kernelFor<ContactKernel>(cpuLanes());
  for (std::size_t type = 0; type < data.cores.size(); ++type) {
    PairsInLanes lanes(kernel.pairs[type]);
    forEachNear(data, data.cores[type], X_WS, cutoff,
                [&](const CorePair& pair, const ContactSolid& a, const Pose& X_WA, const ContactSolid& b,
                    const Pose& X_WB) {
                  lanes.add(pair, a, X_WA, b, X_WB);
                  if (lanes.isFull()) lanes.measure(found);
                });
    lanes.measure(found);
  }
  forEachNear(data, data.others, X_WS, cutoff,
              [&](const CorePair& pair, const ContactSolid& a, const Pose& X_WA, const ContactSolid& b,
                  const Pose& X_WB) {
                found[static_cast<std::size_t>(pair.row)] = proximity(a.form, X_WA, b.form, X_WB);
              });

  near.clear();
  for (std::size_t row = 0; row < found.size(); ++row)
    if (!(found[row].distance >= cutoff)) near.push_back({data.pairs[row], found[row]});
}

std::vector<Proxy> proxies(const ContactModel& contacts, const BodyPoses& poses, double cutoff) {
  ProxyStorage storage;
  proxies(contacts, poses, cutoff, storage);
  return std::move(storage.near);
}

namespace {

std::string pointText(const Eigen::Vector3d& p) {
  // Numbers that round to zero lose their sign.
  const auto rounded = [](double x) { return std::abs(x) < 5e-5 ? 0. : x; };
  return fmt::format("{:9.4f} {:8.4f} {:8.4f}", rounded(p.x()), rounded(p.y()), rounded(p.z()));
}

}  // namespace

std::string shapeLabel(const Model& model, int shape) {
  const auto until = std::span(model.shapes()).first(static_cast<std::size_t>(shape) + 1);
  const ModelShape& chosen = until.back();
  const bool isNamed = !chosen.name.empty();
  // Shapes that are only visual are not counted among shapes in contact, although they may have the same
  // name.
  const auto isAlike = [&](const ModelShape& one) {
    return one.body == chosen.body && one.name == chosen.name && (!isNamed || one.contact == chosen.contact);
  };
  if (isNamed && std::ranges::count_if(model.shapes(), isAlike) == 1) return chosen.name;
  return fmt::format("{}#{}", isNamed ? chosen.name : model[chosen.body].name,
                     std::ranges::count_if(until, isAlike));
}

std::string proxyReport(const Model& model, std::span<const Proxy> proxies) {
  std::vector<Proxy> sorted(proxies.begin(), proxies.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const Proxy& one, const Proxy& other) {
    const double d = one.proximity.distance, e = other.proximity.distance;
    return d < e || (std::isnan(d) && !std::isnan(e));
  });
  std::vector<std::string> names = {"pair"};
  for (const Proxy& one : sorted)
    names.push_back(shapeLabel(model, one.pair.a) + " - " + shapeLabel(model, one.pair.b));
  std::size_t width = 0;
  for (const std::string& name : names) width = std::max(width, name.size());

  std::string text = fmt::format("{:{}} {:>9} {:>27} {:>27}\n", names[0], width, "distance",
                                 "point of the first", "point of the second");
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const Proximity& near = sorted[i].proximity;
    text += fmt::format("{:{}} {:>9.4f} {} {}\n", names[i + 1], width, near.distance, pointText(near.p_WA),
                        pointText(near.p_WB));
  }
  return text;
}

namespace {

using internal::CoupledMotion;
using internal::HomeOverlap;
using internal::RigidParts;

using BodyPair = std::pair<BodyId, BodyId>;

BodyPair inOrder(BodyId a, BodyId b) { return std::minmax(a, b); }

// A body and its nearest ancestors without the world, which does not count as kin.
class Kin {
 public:
  Kin(const Model& model, BodyId body) {
    for (BodyId at = body; at != kWorld && count_ < line_.size(); at = model[at].parent) line_[count_++] = at;
  }
  bool meets(const Kin& other) const {
    return std::find_first_of(begin(), end(), other.begin(), other.end()) != end();
  }

 private:
  static constexpr std::size_t kGenerations = 4;
  const BodyId* begin() const { return line_.data(); }
  const BodyId* end() const { return line_.data() + count_; }
  std::array<BodyId, kGenerations + 1> line_{};
  std::size_t count_ = 0;
};

bool hasJointTo(const Model& model, BodyId child, BodyId parent) {
  if (model[child].parent != parent || model[child].joint == kNoJoint) return false;
  return parent != kWorld || model[model[child].joint].type != JointType::kFree;
}

// What the scene says about pairs by name.
class Choices {
 public:
  explicit Choices(const Model& model) {
    for (const PairChoice& choice : model.collisionChoices()) {
      if (!choice.b) {
        ofAll_.emplace(choice.a, &choice);
        continue;
      }
      const PairChoice*& known = ofPairs_[inOrder(choice.a, *choice.b)];
      if (known == nullptr || !choice.mayCollide) known = &choice;
    }
  }

  // The choice for the pair; null if there is none.
  const PairChoice* find(BodyId a, BodyId b) const {
    if (const auto found = ofPairs_.find(inOrder(a, b)); found != ofPairs_.end()) return found->second;
    const PairChoice* ofOne = nullptr;
    for (const BodyId body : {a, b})
      if (const auto found = ofAll_.find(body); found != ofAll_.end())
        if (ofOne == nullptr || !found->second->mayCollide) ofOne = found->second;
    return ofOne;
  }

 private:
  std::map<BodyPair, const PairChoice*> ofPairs_;
  std::map<BodyId, const PairChoice*> ofAll_;
};

// The masks of the shapes of bodies, each once. Most scenes have only the usual ones.
class Masks {
 public:
  explicit Masks(const Model& model) : ofBody_(model.bodies().size()) {
    for (const ModelShape& shape : model.shapes()) {
      if (!internal::takesPart(shape)) continue;
      areUsual_ &= shape.mask == ContactMask{};
      havePairs_ |= !shape.mask.pairs.empty();
      std::vector<ContactMask>& known = ofBody_[static_cast<std::size_t>(shape.body)];
      if (std::ranges::find(known, shape.mask) == known.end()) known.push_back(shape.mask);
    }
  }
  bool mayTouch(BodyId a, BodyId b) const { return areUsual_ || any(a, b, rex::mayTouch); }
  bool arePaired(BodyId a, BodyId b) const { return havePairs_ && any(a, b, rex::arePaired); }

 private:
  bool any(BodyId a, BodyId b, bool (*isSo)(const ContactMask&, const ContactMask&)) const {
    for (const ContactMask& one : ofBody_[static_cast<std::size_t>(a)])
      for (const ContactMask& other : ofBody_[static_cast<std::size_t>(b)])
        if (isSo(one, other)) return true;
    return false;
  }

  std::vector<std::vector<ContactMask>> ofBody_;
  bool areUsual_ = true, havePairs_ = false;
};

// Decides which pairs of bodies may collide.
class Judge {
 public:
  explicit Judge(const Model& model)
      : model_(model),
        parts_(model),
        coupled_(model),
        masks_(model),
        choices_(model),
        rule_(model.collisionRule()) {
    if (rule_ == CollisionRule::kFourGenerations) return;
    const auto isAsked = [&](const ModelShape& a, const ModelShape& b) {
      return mayTouch(a.mask, b.mask) && !arePaired(a.mask, b.mask) &&
             parts_.freeJoint(a.body) == parts_.freeJoint(b.body) &&
             reasonByTree(a.body, b.body) == PairReason::kNone;
    };
    for (const HomeOverlap& overlap : internal::homeOverlaps(model, kHomeTolerance, isAsked)) {
      HomeOverlap& deepest = overlaps_[inOrder(bodyOf(overlap.pair.a), bodyOf(overlap.pair.b))];
      if (overlap.depth > deepest.depth) deepest = overlap;
    }
  }

  PairVerdict verdict(BodyId a, BodyId b) const {
    PairVerdict verdict{.a = std::min(a, b), .b = std::max(a, b), .reason = reasonByTree(a, b)};
    verdict.mayCollide = verdict.reason == PairReason::kNone;
    if (verdict.reason == PairReason::kChosen) {
      const PairChoice* choice = choices_.find(a, b);
      verdict.mayCollide = choice->mayCollide;
      verdict.said = choice->reason;
    }
    if (!verdict.mayCollide && arePairedThere(a, b)) {
      verdict.mayCollide = true;
      verdict.reason = PairReason::kChosen;
      verdict.said = "pairs of shapes";
    }
    const auto overlap = overlaps_.find(inOrder(a, b));
    if (overlap == overlaps_.end() || arePairedThere(a, b)) return verdict;
    verdict.reason = PairReason::kOverlapAtHome;
    verdict.mayCollide = false;
    verdict.deepest = overlap->second.pair;
    verdict.depth = overlap->second.depth;
    return verdict;
  }

  // Whether shapes of theirs are pairs in their masks, and can touch.
  bool arePairedThere(BodyId a, BodyId b) const {
    return masks_.arePaired(a, b) && parts_.part(a) != parts_.part(b) && !coupled_.cancels(a, b);
  }

  // The same decision as verdict() for shapes that are no pair, without its explanation.
  bool mayCollide(BodyId a, BodyId b) const {
    const PairReason reason = reasonByTree(a, b);
    if (reason == PairReason::kChosen) return choices_.find(a, b)->mayCollide;
    return reason == PairReason::kNone && !overlaps_.contains(inOrder(a, b));
  }

  // The overlaps at home of pairs that could collide otherwise.
  const std::map<BodyPair, HomeOverlap>& overlaps() const { return overlaps_; }

 private:
  BodyId bodyOf(int shape) const { return model_.shapes()[static_cast<std::size_t>(shape)].body; }

  PairReason reasonByTree(BodyId a, BodyId b) const {
    if (parts_.part(a) == parts_.part(b)) return PairReason::kSamePart;
    if (coupled_.cancels(a, b)) return PairReason::kCannotMove;
    if (!masks_.mayTouch(a, b)) return PairReason::kMasks;
    if (choices_.find(a, b) != nullptr) return PairReason::kChosen;
    if (rule_ == CollisionRule::kFourGenerations) {
      if (hasJointTo(model_, a, b) || hasJointTo(model_, b, a) || parts_.arePinned(a, b))
        return PairReason::kNeighbours;
      return Kin(model_, a).meets(Kin(model_, b)) ? PairReason::kFourGenerations : PairReason::kNone;
    }
    return parts_.areNeighbours(a, b) ? PairReason::kNeighbours : PairReason::kNone;
  }

  const Model& model_;
  RigidParts parts_;
  CoupledMotion coupled_;
  Masks masks_;
  Choices choices_;
  CollisionRule rule_;
  std::map<BodyPair, HomeOverlap> overlaps_;
};

// The shapes in contact, grouped by body; those of a body are adjacent in the model.
std::vector<std::vector<int>> shapesInContact(const Model& model) {
  std::vector<std::vector<int>> groups;
  BodyId last{-1};
  for (std::size_t i = 0; i < model.shapes().size(); ++i) {
    const ModelShape& shape = model.shapes()[i];
    if (!internal::takesPart(shape)) continue;
    if (groups.empty() || shape.body != last) groups.emplace_back();
    groups.back().push_back(static_cast<int>(i));
    last = shape.body;
  }
  return groups;
}

BodyId bodyOf(const Model& model, const std::vector<int>& group) {
  return model.shapes()[static_cast<std::size_t>(group.front())].body;
}

std::string nameOf(const Model& model, BodyId body) { return model[body].name; }

std::string overlapWarning(const Model& model, const PairVerdict& verdict) {
  const std::string a = nameOf(model, verdict.a), b = nameOf(model, verdict.b);
  return fmt::format(
      "'{0}' and '{1}' overlap at home by {2:.3g} m (shapes '{3}' and '{4}'), so their collisions are never "
      "checked: <disable_collisions link1=\"{0}\" link2=\"{1}\"/> in an SRDF says that this is intended, "
      "<enable_collisions .../> lets them collide",
      a, b, verdict.depth, shapeLabel(model, verdict.deepest->a), shapeLabel(model, verdict.deepest->b));
}

}  // namespace

std::string toString(const PairVerdict& verdict, const Model& model) {
  switch (verdict.reason) {
    case PairReason::kSamePart:
      return "fixed to each other";
    case PairReason::kCannotMove:
      return "coupled joints keep them in place";
    case PairReason::kMasks:
      return "no common bit of contype and conaffinity";
    case PairReason::kChosen:
      return fmt::format("{}{}{}", verdict.mayCollide ? "enabled" : "disabled",
                         verdict.said.empty() ? "" : ": ", verdict.said);
    case PairReason::kNeighbours:
      return "neighbours";
    case PairReason::kFourGenerations:
      return "within four generations";
    case PairReason::kOverlapAtHome:
      return fmt::format("overlap at home by {:.3g} m ('{}' and '{}')", verdict.depth,
                         shapeLabel(model, verdict.deepest->a), shapeLabel(model, verdict.deepest->b));
    case PairReason::kNone:
      return "may collide";
  }
  return "";
}

std::vector<PairVerdict> pairVerdicts(const Model& model) {
  const std::vector<std::vector<int>> groups = shapesInContact(model);
  const Judge judge(model);
  std::vector<PairVerdict> verdicts;
  for (auto a = groups.begin(); a != groups.end(); ++a)
    for (auto b = a + 1; b != groups.end(); ++b)
      verdicts.push_back(judge.verdict(bodyOf(model, *a), bodyOf(model, *b)));
  return verdicts;
}

std::vector<ShapePair> collidingPairs(const Model& model) {
  const std::vector<std::vector<int>> groups = shapesInContact(model);
  const Judge judge(model);
  std::vector<ShapePair> pairs;
  struct Partner {
    int shape;
    bool mayCollide;  // otherwise only as a pair
  };
  std::vector<Partner> partners;
  const auto maskOf = [&](int shape) -> const ContactMask& {
    return model.shapes()[static_cast<std::size_t>(shape)].mask;
  };
  for (auto a = groups.begin(); a != groups.end(); ++a) {
    partners.clear();
    for (auto b = a + 1; b != groups.end(); ++b) {
      const BodyId first = bodyOf(model, *a), second = bodyOf(model, *b);
      const bool mayCollide = judge.mayCollide(first, second);
      if (!mayCollide && !judge.arePairedThere(first, second)) continue;
      for (const int shape : *b) partners.push_back({shape, mayCollide});
    }
    for (const int shape : *a)
      for (const auto& [partner, mayCollide] : partners) {
        const auto isAllowed = mayCollide ? mayTouch : arePaired;
        if (isAllowed(maskOf(shape), maskOf(partner))) pairs.push_back({shape, partner});
      }
  }
  return pairs;
}

Diagnostics collisionWarnings(const Model& model) {
  Diagnostics warnings;
  const auto warn = [&](std::string message) {
    warnings.push_back({{model.name()}, std::move(message), Severity::kWarning});
  };
  const Judge judge(model);
  for (const auto& [pair, overlap] : judge.overlaps())
    warn(overlapWarning(model, judge.verdict(pair.first, pair.second)));
  for (const PairChoice& choice : model.collisionChoices()) {
    if (!choice.b || !choice.mayCollide) continue;
    const PairVerdict verdict = judge.verdict(choice.a, *choice.b);
    if (verdict.reason != PairReason::kSamePart && verdict.reason != PairReason::kCannotMove) continue;
    warn(fmt::format("'{}' and '{}' are enabled, which has no effect: {}", nameOf(model, choice.a),
                     nameOf(model, *choice.b), toString(verdict, model)));
  }
  return warnings;
}

}  // namespace rex

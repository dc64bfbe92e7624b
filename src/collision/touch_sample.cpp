#include "collision/touch_sample.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "base/require.h"
#include "collision/contacts.h"
#include "kinematics/forward_kinematics.h"
#include "scene/state.h"

namespace rex {
namespace {

bool turnsWithoutMoving(const DegreeOfFreedom& freedom) {
  return !freedom.angular.isZero() && std::abs(freedom.angular.dot(freedom.linear)) < 1e-12;
}

// The range from which each coordinate is drawn.
class Ranges {
 public:
  explicit Ranges(const Model& model)
      : model_(model), low_(model.initialPositions()), high_(model.initialPositions()) {
    forEachPlainCoordinate(model, [&](int iq, int, const DegreeOfFreedom& freedom) {
      const double lower = model.lowerLimits()[iq], upper = model.upperLimits()[iq];
      if (std::isfinite(lower) && std::isfinite(upper)) {
        low_[iq] = lower;
        high_[iq] = upper;
      } else if (turnsWithoutMoving(freedom) && !std::isfinite(lower) && !std::isfinite(upper)) {
        low_[iq] = -std::numbers::pi;
        high_[iq] = std::numbers::pi;
      } else {
        const std::string& name = jointOfPosition(model, iq).name;
        if (held_.empty() || held_.back() != name) held_.push_back(name);
      }
    });
  }

  void draw(Rng& rng, Eigen::VectorXd& q) const {
    for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = rng.uniform(low_[i], high_[i]);
    forEachQuaternion(model_, [&](int iq, int) { q.segment<4>(iq) = rng.normalVector(4).normalized(); });
  }

  const std::vector<std::string>& held() const { return held_; }

 private:
  const Model& model_;
  Eigen::VectorXd low_, high_;
  std::vector<std::string> held_;
};

// All pairs of shapes of two bodies in contact.
std::vector<ShapePair> shapePairs(const Model& model,
                                  const std::map<std::pair<BodyId, BodyId>, std::size_t>& asked) {
  std::vector<ShapePair> pairs;
  const std::vector<ModelShape>& shapes = model.shapes();
  const auto takesPart = [&](std::size_t i) {
    return shapes[i].contact && shapes[i].shape.type != ShapeType::kMarker;
  };
  for (std::size_t a = 0; a < shapes.size(); ++a)
    for (std::size_t b = a + 1; takesPart(a) && b < shapes.size(); ++b)
      if (takesPart(b) && mayTouch(shapes[a].mask, shapes[b].mask) &&
          asked.contains(std::minmax(shapes[a].body, shapes[b].body)))
        pairs.push_back({static_cast<int>(a), static_cast<int>(b)});
  return pairs;
}

}  // namespace

TouchSample sampleTouches(const Model& model, int postures, Rng& rng) {
  requireCount("number of random postures", postures, 1);
  TouchSample sample{.postures = postures};
  std::map<std::pair<BodyId, BodyId>, std::size_t> places;
  for (PairVerdict& verdict : pairVerdicts(model)) {
    if (!verdict.mayCollide && verdict.reason != PairReason::kOverlapAtHome) continue;
    places.emplace(std::pair(verdict.a, verdict.b), sample.pairs.size());
    sample.pairs.push_back({std::move(verdict)});
  }
  const ContactModel contacts(model, shapePairs(model, places));
  const Ranges ranges(model);
  sample.held = ranges.held();
  Eigen::VectorXd q(model.nq());
  BodyPoses poses;
  ProxyStorage storage;
  std::set<std::size_t> touching;
  for (int k = 0; k < postures; ++k) {
    ranges.draw(rng, q);
    forwardKinematics(model, q, poses);
    proxies(contacts, poses, 0, storage);
    touching.clear();
    for (const Proxy& proxy : storage.near)
      touching.insert(places.at(std::minmax(contacts.body(proxy.pair.a), contacts.body(proxy.pair.b))));
    for (const std::size_t place : touching) ++sample.pairs[place].touches;
  }
  return sample;
}

std::vector<CollisionChoice> suggestedChoices(const Model& model, const TouchSample& sample) {
  std::vector<CollisionChoice> choices;
  for (const auto& [verdict, touches] : sample.pairs) {
    const bool overlaps = verdict.reason == PairReason::kOverlapAtHome;
    if (verdict.reason == PairReason::kChosen) continue;
    if (touches > 0 && touches < sample.postures && !overlaps) continue;
    const char* const reason = touches == sample.postures ? "Always" : overlaps ? "Default" : "Never";
    choices.push_back({model[verdict.a].name, model[verdict.b].name, false, reason});
  }
  return choices;
}

}  // namespace rex

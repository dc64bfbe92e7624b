#include "planning/float_lanes_internal.h"
#include "planning/sphere_kernel_internal.h"

namespace rex::internal {
namespace {

using Kind = SphereObstacle::Kind;

// The first stretches of a motion are so short that the joints' reach moves no sphere further, metres.
constexpr float kCoarseTravel = 0.12f;

template <class V>
struct Vec {
  V x, y, z;
};

template <class V>
inline V dot(const Vec<V>& a, const Vec<V>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
inline Vec<V> operator+(const Vec<V>& a, const Vec<V>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
inline Vec<V> operator-(const Vec<V>& a, const Vec<V>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
inline Vec<V> operator*(const V& a, const Vec<V>& b) {
  return {a * b.x, a * b.y, a * b.z};
}
template <class V>
inline Vec<V> cross(const Vec<V>& a, const Vec<V>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class V>
struct Frame {
  Vec<V> axis[3];
  Vec<V> p;
};

// Adds R times constants, of which many are zero.
template <class V>
inline Vec<V> shifted(const Frame<V>& X, const float* p) {
  Vec<V> result = X.p;
  for (int i = 0; i < 3; ++i)
    if (p[i] != 0) result = result + V(p[i]) * X.axis[i];
  return result;
}

template <class V>
inline void turn(const SphereLink& link, const Frame<V>& parent, Frame<V>& X) {
  for (int i = 0; i < 3; ++i) {
    if (link.isExchange) {
      X.axis[i] = V(link.sign[i]) * parent.axis[link.axis[i]];
    } else {
      const float* column = link.R_PL + 3 * i;
      X.axis[i] =
          V(column[0]) * parent.axis[0] + V(column[1]) * parent.axis[1] + V(column[2]) * parent.axis[2];
    }
  }
}

// Eight postures of the robot: its frames, and centres of nodes as far as they were asked for.
template <class V>
struct Postures {
  Frame<V> links[kMostLinks];
  Vec<V> centers[kMostNodes];
  bool isPlaced[kMostNodes];
};

template <class V>
Frame<V> world() {
  const V zero(0.0f), one(1.0f);
  return {{{one, zero, zero}, {zero, one, zero}, {zero, zero, one}}, {zero, zero, zero}};
}

template <class V>
inline void place(const SphereScene& scene, const V* q, Postures<V>& at) {
  const Frame<V> origin = world<V>();
  for (int l = 0; l < scene.linkCount; ++l) {
    const SphereLink& link = scene.links[l];
    Frame<V>& X = at.links[l];
    const Frame<V>& parent = link.parent < 0 ? origin : at.links[link.parent];
    X.p = shifted(parent, link.p_PL);
    turn(link, parent, X);
    const V x = V(link.ratio) * q[link.qIndex] + V(link.offset);
    if (!link.isHinge) {
      X.p = X.p + x * X.axis[2];
      continue;
    }
    V s, c;
    sineAndCosine(x, s, c);
    const Vec<V> first = X.axis[0];
    X.axis[0] = c * first + s * X.axis[1];
    X.axis[1] = c * X.axis[1] - s * first;
  }
  for (int i = 0; i < scene.nodeCount; ++i) at.isPlaced[i] = false;
}

template <class V>
inline const Vec<V>& centerOf(const SphereScene& scene, int link, int node, Postures<V>& at) {
  if (!at.isPlaced[node]) {
    const float* center = scene.nodes[node].center;
    if (link < 0)
      at.centers[node] = {V(center[0]), V(center[1]), V(center[2])};
    else
      at.centers[node] = shifted(at.links[link], center);
    at.isPlaced[node] = true;
  }
  return at.centers[node];
}

template <class V>
inline V outside(const V& x, float half) {
  return larger(absolute(x) - V(half), V(0.0f));
}

// Whether a ball overlaps the obstacle.
template <class V>
inline typename V::Mask isNear(const SphereObstacle& obstacle, const Vec<V>& center, const V& radius) {
  const Vec<V> d = center - Vec<V>{V(obstacle.p[0]), V(obstacle.p[1]), V(obstacle.p[2])};
  const float* R = obstacle.R;
  const auto along = [&](int i) { return V(R[3 * i]) * d.x + V(R[3 * i + 1]) * d.y + V(R[3 * i + 2]) * d.z; };
  switch (obstacle.kind) {
    case Kind::kUprightBox: {
      const V x = outside(V(R[0]) * d.x + V(R[1]) * d.y, obstacle.half[0]);
      const V y = outside(V(R[3]) * d.x + V(R[4]) * d.y, obstacle.half[1]);
      const V z = outside(d.z, obstacle.half[2]);
      return x * x + y * y + z * z < radius * radius;
    }
    case Kind::kBox: {
      const V x = outside(along(0), obstacle.half[0]), y = outside(along(1), obstacle.half[1]),
              z = outside(along(2), obstacle.half[2]);
      return x * x + y * y + z * z < radius * radius;
    }
    case Kind::kCapsule: {
      const V z = along(2), half(obstacle.half[2]), r = radius + V(obstacle.radius);
      const V nearest = smaller(larger(z, V(0.0f) - half), half);
      const Vec<V> apart = d - nearest * Vec<V>{V(R[6]), V(R[7]), V(R[8])};
      return dot(apart, apart) < r * r;
    }
    case Kind::kCylinder:
      break;
  }
  const V z = along(2), above = outside(z, obstacle.half[2]);
  const Vec<V> aside = d - z * Vec<V>{V(R[6]), V(R[7]), V(R[8])};
  const V rest = radius * radius - above * above;
  const V r = V(obstacle.radius) + rooted(larger(rest, V(0.0f)));
  return (dot(aside, aside) < r * r) & (V(0.0f) < rest);
}

// Which of eight postures are proven free of overlap for the time around them, and whether one of them
// overlaps.
struct Verdict {
  unsigned unproven = 0;
  bool isOverlap = false;
};

// Eight stretches of a motion: their middles as postures, half their durations, and bounds for the whole
// motion.
template <class V>
struct Stretches {
  V q[kMostCoordinates];
  V half;
  const float* step = nullptr;           // of each coordinate, during the motion
  const float* accelerations = nullptr;  // of the centres of the spheres of each link, at most
  const float* approaches = nullptr;     // of each pair of links
};

template <class V>
inline V onlyProven(const V& x, unsigned unproven) {
  float kept[8];
  storeEight(x, kept);
  for (int i = 0; i < 8; ++i)
    if (unproven >> i & 1u) kept[i] = 0;
  return loadAt<V>(kept);
}

// Notes what a leaf found; false if that is an overlap.
template <class V, class IsNear>
inline bool judgeLeaf(unsigned hits, const IsNear& isOverlap, Verdict& verdict, V& travel) {
  if (bitsOfLanes(isOverlap()) != 0) {
    verdict.isOverlap = true;
    return false;
  }
  verdict.unproven |= hits;
  travel = onlyProven(travel, verdict.unproven);
  return true;
}

// The spheres of a whole link against the obstacles in its reach.
template <class V>
bool checkGuard(const SphereScene& scene, const SphereGuard& guard, V travel, Postures<V>& at,
                Verdict& verdict) {
  const SphereGroup& group = scene.groups[guard.group];
  const int end = scene.nodes[group.node].next;
  for (int o = 0; o < guard.obstacleCount; ++o) {
    const SphereObstacle& obstacle = scene.obstacles[guard.obstacles[o]];
    for (int n = group.node; n < end;) {
      const SphereNode& node = scene.nodes[n];
      const Vec<V>& center = centerOf(scene, group.link, n, at);
      const float radius = node.radius + scene.slack;
      const unsigned hits = bitsOfLanes(isNear(obstacle, center, V(radius) + travel));
      if (hits == 0) {
        n = node.next;
        continue;
      }
      if (node.isLeaf) {
        const auto isOverlap = [&] { return isNear(obstacle, center, V(radius)); };
        if (!judgeLeaf(hits, isOverlap, verdict, travel)) return false;
      }
      ++n;
    }
  }
  return true;
}

template <class V>
inline typename V::Mask areNear(const Vec<V>& a, const Vec<V>& b, const V& reach) {
  const Vec<V> apart = a - b;
  return dot(apart, apart) < reach * reach;
}

template <class V>
inline bool isLinkPairNear(const SphereScene& scene, const SpherePair& pair, const V& travel,
                           Postures<V>& at) {
  const SphereGroup &a = scene.groups[pair.a], &b = scene.groups[pair.b];
  const float reach = scene.nodes[a.node].radius + scene.nodes[b.node].radius + scene.slack;
  return bitsOfLanes(areNear(centerOf(scene, a.link, a.node, at), centerOf(scene, b.link, b.node, at),
                             V(reach) + travel)) != 0;
}

template <class V>
bool checkPair(const SphereScene& scene, const SpherePair& pair, V travel, Postures<V>& at,
               Verdict& verdict) {
  const SphereGroup &a = scene.groups[pair.a], &b = scene.groups[pair.b];
  const auto endOf = [&](const SphereGroup& group) { return scene.nodes[group.node].next; };
  for (int i = a.node; i < endOf(a);) {
    const SphereNode& one = scene.nodes[i];
    const Vec<V>& center = centerOf(scene, a.link, i, at);
    bool isAnyNear = false;
    for (int j = b.node; j < endOf(b);) {
      const SphereNode& other = scene.nodes[j];
      const Vec<V>& otherCenter = centerOf(scene, b.link, j, at);
      const float reach = one.radius + other.radius + scene.slack;
      const unsigned hits = bitsOfLanes(areNear(center, otherCenter, V(reach) + travel));
      if (hits == 0) {
        j = other.next;
        continue;
      }
      isAnyNear = true;
      if (!one.isLeaf) break;  // its children look closer
      if (other.isLeaf) {
        const auto isOverlap = [&] { return areNear(center, otherCenter, V(reach)); };
        if (!judgeLeaf(hits, isOverlap, verdict, travel)) return false;
      }
      ++j;
    }
    i = isAnyNear ? i + 1 : one.next;
  }
  return true;
}

// How far the centre of any sphere of a link moves at most during half a stretch: by its speed in the middle
// and a bound of the acceleration.
template <class V>
struct Speeds {
  Vec<V> angular[kMostLinks], linear[kMostLinks];
};

template <class V>
inline void differentiate(const SphereScene& scene, const float* step, const Postures<V>& at,
                          Speeds<V>& speeds) {
  for (int l = 0; l < scene.linkCount; ++l) {
    const SphereLink& link = scene.links[l];
    const Frame<V>& X = at.links[l];
    const V rate(link.ratio * step[link.qIndex]);
    const V zero(0.0f);
    Vec<V> angular{zero, zero, zero}, linear{zero, zero, zero};
    if (link.parent >= 0) {
      angular = speeds.angular[link.parent];
      linear = speeds.linear[link.parent] + cross(angular, X.p - at.links[link.parent].p);
    }
    if (link.isHinge)
      angular = angular + rate * X.axis[2];
    else
      linear = linear + rate * X.axis[2];
    speeds.angular[l] = angular;
    speeds.linear[l] = linear;
  }
}

template <class V>
Verdict check(const SphereScene& scene, const Stretches<V>& motion, Postures<V>& at) {
  Verdict verdict;
  place(scene, motion.q, at);
  Speeds<V> speeds;
  differentiate(scene, motion.step, at, speeds);
  for (int g = scene.guardCount - 1; g >= 0; --g) {
    const SphereGuard& guard = scene.guards[g];
    const SphereGroup& group = scene.groups[guard.group];
    const Vec<V>& center = centerOf(scene, group.link, group.node, at);
    const Vec<V>& angular = speeds.angular[group.link];
    const Vec<V> linear = speeds.linear[group.link] + cross(angular, center - at.links[group.link].p);
    const V speed = rooted(dot(linear, linear)) + V(group.spread) * rooted(dot(angular, angular));
    const V half = verdict.unproven == 0 ? motion.half : onlyProven(motion.half, verdict.unproven);
    const V travel = half * (speed + half * V(0.5f * motion.accelerations[group.link]));
    if (!checkGuard(scene, guard, travel, at, verdict)) return verdict;
  }
  for (int p = 0; p < scene.linkPairCount; ++p) {
    const SphereLinkPair& pair = scene.linkPairs[p];
    V travel = motion.half * V(motion.approaches[p]);
    if (!isLinkPairNear(scene, pair.links, travel, at)) continue;
    if (verdict.unproven != 0) travel = onlyProven(travel, verdict.unproven);
    for (int i = pair.first; i < pair.end; ++i)
      if (!checkPair(scene, scene.pairs[i], travel, at, verdict)) return verdict;
  }
  return verdict;
}

float size(float x) { return x < 0 ? -x : x; }

// Bounds for a whole motion: see Stretches. Returns how far the joints' reach moves any sphere at most.
template <class V>
float bound(const SphereScene& scene, const float* step, float* accelerations, float* approaches) {
  constexpr int kMostRows = (kMostLinks + kMostLinkPairs) / 8;
  const int linkRows = (scene.linkCount + 7) / 8, pairRows = (scene.linkPairCount + 7) / 8;
  V ways[kMostRows], acceleration[kMostRows], approach[kMostRows];
  for (int i = 0; i < linkRows; ++i) ways[i] = acceleration[i] = V(0.0f);
  for (int i = 0; i < pairRows; ++i) approach[i] = V(0.0f);
  float turned = 0;  // by the joints before
  for (int k = 0; k < scene.linkCount; ++k) {
    const SphereLink& link = scene.links[k];
    const float rate = size(link.ratio * step[link.qIndex]), turn = link.isHinge ? rate : 0;
    for (int i = 0; i < linkRows; ++i) {
      const V speed = V(rate) * loadAt<V>(scene.reach + 8 * (k * linkRows + i));
      ways[i] = ways[i] + speed;
      acceleration[i] = acceleration[i] + V(turn + 2 * turned) * speed;
    }
    for (int i = 0; i < pairRows; ++i)
      approach[i] = approach[i] + V(rate) * loadAt<V>(scene.approach + 8 * (k * pairRows + i));
    turned += turn;
  }
  float longest = 0;
  for (int i = 0; i < linkRows; ++i) {
    float way[8];
    storeEight(ways[i], way);
    for (const float each : way) longest = each > longest ? each : longest;
    storeEight(acceleration[i], accelerations + 8 * i);
  }
  for (int i = 0; i < pairRows; ++i) storeEight(approach[i], approaches + 8 * i);
  return longest;
}

// A stretch of a motion from time 0 to 1.
struct Stretch {
  float middle, half;
};

// Stretches that are not proven yet. It never fills up: it grows by less than eight per halving of a stretch.
struct Stack {
  static constexpr int kMost = 512;
  Stretch all[kMost];
  int count = 0;

  bool push(const Stretch& stretch) {
    if (count == kMost) return false;
    all[count++] = stretch;
    return true;
  }
};

// Replaces up to four stretches of the stack by eight parts of them.
inline void divide(Stack& stack, Stretch* parts) {
  const int taken = stack.count < 4 ? stack.count : 4;
  const int each = taken == 3 ? 2 : 8 / taken;
  for (int i = 0; i < 8; ++i) {
    const Stretch& whole = stack.all[stack.count - 1 - (i / each < taken ? i / each : 0)];
    const float half = whole.half / static_cast<float>(each);
    parts[i] = {whole.middle + half * static_cast<float>(2 * (i % each) + 1 - each), half};
  }
  stack.count -= taken;
}

template <class V>
class Motion {
 public:
  Motion(const SphereScene& scene, const float* from, const float* to) : scene_(scene), from_(from) {
    for (int j = 0; j < scene.coordinates; ++j) step_[j] = to[j] - from[j];
    longest_ = bound<V>(scene, step_, accelerations_, approaches_);
    stretches_.step = step_;
    stretches_.accelerations = accelerations_;
    stretches_.approaches = approaches_;
  }

  bool isFree(SphereCount& count) {
    const int blocks = 1 + static_cast<int>(longest_ / (8 * kCoarseTravel));
    const float half = 0.5f / static_cast<float>(8 * blocks);
    Stretch parts[8];
    for (int b = 0; b < blocks; ++b) {
      // Each block is spread over the whole motion, to meet obstacles early wherever they are.
      for (int i = 0; i < 8; ++i) parts[i] = {half * static_cast<float>(2 * (i * blocks + b) + 1), half};
      if (!take(parts, count)) return false;
      if (stack_.count > Stack::kMost / 2 && !proveRest(count)) return false;
    }
    return proveRest(count);
  }

 private:
  // Divides what is not proven yet until it is.
  bool proveRest(SphereCount& count) {
    Stretch parts[8];
    while (stack_.count > 0) {
      if (stack_.all[stack_.count - 1].half * longest_ < scene_.finest) return false;
      divide(stack_, parts);
      if (!take(parts, count)) return false;
    }
    return true;
  }

  // Checks eight stretches and keeps the unproven ones; false in overlap.
  bool take(const Stretch* parts, SphereCount& count) {
    ++count.blocks;
    float middles[8], halves[8];
    for (int i = 0; i < 8; ++i) {
      middles[i] = parts[i].middle;
      halves[i] = parts[i].half;
    }
    const V middle = loadAt<V>(middles);
    stretches_.half = loadAt<V>(halves);
    for (int j = 0; j < scene_.coordinates; ++j) stretches_.q[j] = V(from_[j]) + middle * V(step_[j]);
    const Verdict verdict = check(scene_, stretches_, at_);
    if (verdict.isOverlap) return false;
    for (int i = 0; i < 8; ++i)
      if ((verdict.unproven >> i & 1u) != 0 && !stack_.push(parts[i])) return false;
    return true;
  }

  const SphereScene& scene_;
  const float* from_;
  float step_[kMostCoordinates], accelerations_[kMostLinks], approaches_[kMostLinkPairs];
  float longest_;
  Stretches<V> stretches_;
  Postures<V> at_;
  Stack stack_;
};

template <int kWidth>
bool isMotionFree(const SphereScene& scene, const float* from, const float* to, SphereCount& count) {
  return Motion<Eight<kWidth>>(scene, from, to).isFree(count);
}

template <int kWidth>
int nearestPoint(const float* points, int count, int coordinates, const float* to, float& squared) {
  using V = Eight<kWidth>;
  V best(3e38f), bestBlock(0.0f);
  const int blocks = (count + 7) / 8;
  for (int b = 0; b < blocks; ++b) {
    V sum(0.0f);
    for (int j = 0; j < coordinates; ++j, points += 8) {
      const V apart = loadAt<V>(points) - V(to[j]);
      sum = sum + apart * apart;
    }
    const auto isBetter = sum < best;
    best = select<kWidth>(isBetter, sum, best);
    bestBlock = select<kWidth>(isBetter, V(static_cast<float>(b)), bestBlock);
  }
  float distances[8], ofBlock[8];
  storeEight(best, distances);
  storeEight(bestBlock, ofBlock);
  int found = 0;
  squared = 3e38f;
  for (int i = 0; i < 8; ++i) {
    const int index = 8 * static_cast<int>(ofBlock[i]) + i;
    if (distances[i] > squared || (distances[i] == squared && index > found)) continue;
    squared = distances[i];
    found = index;
  }
  return found;
}

template <int kWidth>
void reachedObstacles(const SphereObstacle* obstacles, int count, const float* centers, const float* radii,
                      unsigned* bits) {
  using V = Eight<kWidth>;
  const Vec<V> center{loadAt<V>(centers), loadAt<V>(centers + 8), loadAt<V>(centers + 16)};
  const V radius = loadAt<V>(radii);
  for (int o = 0; o < count; ++o) bits[o] = bitsOfLanes(isNear(obstacles[o], center, radius));
}

}  // namespace

template <int kLanes>
SphereKernel SphereKernel::compiled() {
  constexpr int kWidth = kLanes == 1 ? 1 : 2 * kLanes;
  return {&isMotionFree<kWidth>, &nearestPoint<kWidth>, &reachedObstacles<kWidth>};
}
template SphereKernel SphereKernel::compiled<REX_LANES>();

}  // namespace rex::internal

#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "grading/check.h"
#include "interface.h"
#include "maps.h"
#include "plan_evidence.h"
#include "yard_checks.h"

// The checks of part 4: where samplers put nodes.

using Samples = std::vector<Eigen::Vector2d>;

// The labels of the generators that students get.
inline rex::Rng generatorsOf(rex::grading::Check& check) { return check.rng().split(7); }

// The samplers, and what to ask if a returned node is not free.
struct Sampler {
  const char *name, *question;
};
inline constexpr Sampler kUniform{"uniformSample", "Is the point tested?"},
    kGaussian{"gaussianSample", "Which of the two points is the node? It is the free one."},
    kBridge{"bridgeSample", "Is the middle tested? It has to be free, and both ends blocked."};

// `count` nodes, or as many as that many attempts find; each attempt has random numbers of its own.
template <class Sample>
Samples gathered(rex::grading::Check& check, rex::Rng& given, const Yard& yard, int count, int attempts,
                 const Sampler& sampler, const Sample& sample) {
  Samples samples;
  for (int i = 0; i < attempts && std::ssize(samples) < count; ++i) {
    const std::optional<Eigen::Vector2d> q = sample(check.split(given.next()));
    if (!q) continue;
    const auto shown = check.show([&] {
      rex::grading::Evidence evidence = samplesSeen(std::string("Nodes of ") + sampler.name, yard, samples);
      if (q->allFinite())
        evidence.figures.front().series.push_back(rex::grading::wrongPoint("got, not free", q->x(), q->y()));
      return evidence;
    });
    const auto asked = check.ask(sampler.question);
    holdsWhere(check, std::string("every node of ") + sampler.name + " is free",
               q->allFinite() && isFree(yard, *q), fmt::format("node ({:.4g}, {:.4g})", q->x(), q->y()));
    samples.push_back(*q);
  }
  return samples;
}

inline double share(const Samples& samples, const Block& block) {
  double inside = 0;
  for (const Eigen::Vector2d& q : samples) inside += nearestPoint(block, q) == q ? 1 : 0;
  return inside / static_cast<double>(samples.size());
}

inline double fromBorder(const Yard& yard, const Eigen::Vector2d& q) {
  return std::min(q.minCoeff(), (yard.size - q).minCoeff());
}

/// The same random numbers give the same answer, and not every attempt finds a node.
template <class Sample>
void attemptsFit(rex::grading::Check& check, rex::Rng& given, const Sampler& sampler, double most,
                 const Sample& sample) {
  const std::string name = sampler.name;
  double found = 0;
  for (int i = 0; i < 200; ++i) {
    const rex::remote::SplitRng rng = check.split(given.next());
    const std::optional<Eigen::Vector2d> once = sample(rng), again = sample(rng);
    const auto own = check.ask("Does it use a generator of its own? All randomness comes from rng.");
    check.that(name + " returns the same again with the same rng", once == again);
    found += once ? 1 : 0;
  }
  const auto loop = check.ask("Does it try until a node is found? It makes one attempt.", found == 200);
  check.atMost("number of nodes of " + name + " from 200 attempts", found, most);
}

/// 2000 uniform nodes: half of them lie in each half, up to 6 standard deviations of 0.011.
inline void uniformFits(rex::grading::Check& check, Student& student, rex::Rng& given) {
  const Yard wall{{4, 4}, {{{0, 0}, {2, 4}}}};
  check.input("a yard of 4 x 4 m whose left half is a block");
  const auto sample = [&](const auto& rng) { return student.uniformSample(wall, rng); };
  attemptsFit(check, given, kUniform, 150, sample);
  const Samples nodes = gathered(check, given, wall, 2000, 6000, kUniform, sample);
  const auto shown = check.show(
      [&] { return samplesSeen("Uniform nodes; wanted: evenly over the free half", wall, nodes); });
  check.atLeast("number of nodes of uniformSample from 6000 attempts", static_cast<double>(nodes.size()),
                2000);
  const auto evenly = check.ask("Are both coordinates uniform, from 0 to the size of the yard?");
  const auto half = [&](const char* where, const Block& part) {
    check.near(fmt::format("share of the nodes of uniformSample in the {} half", where), share(nodes, part),
               0.5, 0.067);
  };
  half("upper", {{2, 2}, {4, 4}});
  half("right", {{3, 0}, {4, 4}});
  half("middle (1 m < y < 3 m)", {{2, 1}, {4, 3}});
  half("middle (2.5 m < x < 3.5 m)", {{2.5, 0}, {3.5, 4}});
}

// Far from the border of the yard, the density at a distance x from the wall is proportional to P(N(0,
// sigma) > x). In sigmas, its mean is sqrt(2 pi) / 4 = 0.627 with a deviation of 0.523, its mean square 2 /
// 3 with one of 1.075, and 11.4 % lie beyond 1.3. Six standard deviations are tolerated.
inline void gaussianFits(rex::grading::Check& check, Student& student, rex::Rng& given) {
  const double sigma = check.rng().uniform(0.25, 0.3);
  const Yard wall{{12, 4}, {{{0, 0}, {12, 2}}}};
  check.input("a yard of 12 x 4 m whose lower half is a block", {{"sigma", sigma}});
  const auto sample = [&](const auto& rng) { return student.gaussianSample(wall, sigma, rng); };
  attemptsFit(check, given, kGaussian, 120, sample);
  const Samples nodes = gathered(check, given, wall, 12000, 12000, kGaussian, sample);
  std::vector<double> distances;
  for (const Eigen::Vector2d& q : nodes)
    if (q.x() >= 1.2 && q.x() <= 10.8 && q.y() <= 3.2) distances.push_back((q.y() - 2) / sigma);
  const auto shown = check.show([&] {
    rex::grading::Evidence evidence = samplesSeen("Gaussian nodes; wanted: near the wall", wall, nodes);
    if (!distances.empty()) evidence.figures.insert(evidence.figures.begin(), distancesSeen(distances));
    return evidence;
  });
  const double count = static_cast<double>(distances.size()), forgiven = 6 / std::sqrt(count);
  // Of the pairs, 24000 / 48 sigma / sqrt(2 pi) per metre of wall: up to six standard deviations fewer.
  const double wanted = 9.6 * 500 * sigma / std::sqrt(2 * M_PI);
  const auto both = check.ask("Is q2 the node if q2 is free and q1 is not? The slide says: or vice versa.",
                              std::abs(count / wanted - 0.5) < 0.15);
  check.atLeast("number of nodes of gaussianSample at the wall, from 12000 attempts", count, 0.7 * wanted);
  const Eigen::ArrayXd d = Eigen::Map<const Eigen::ArrayXd>(distances.data(), std::ssize(distances));
  const auto sharp = check.ask(
      "Is every free point near a block a node? The other point is at a normal distance, and not free.",
      d.maxCoeff() < 1.5);
  const auto root = check.ask("Is sigma taken for the variance? It is the standard deviation.",
                              std::abs(d.mean() - 0.627 / std::sqrt(sigma)) < 0.1);
  check.near("mean distance of the nodes of gaussianSample from the wall, in sigmas", d.mean(), 0.627,
             0.523 * forgiven);
  check.near("mean square of this distance, in sigmas squared", d.square().mean(), 2 / 3., 1.075 * forgiven);
  check.near("share of the nodes of gaussianSample more than 1.3 sigmas from the wall",
             (d > 1.3).cast<double>().mean(), 0.114, 0.318 * forgiven);
}

/// Blocks everywhere except for a strip that rises, or falls, by 45 degrees, 0.2 m high.
inline Yard diagonalStrip(bool rises) {
  Yard yard{{4, 4}, {}};
  for (int i = 0; i < 80; ++i) {
    const double left = 0.05 * i, middle = rises ? left + 0.025 : 3.975 - left;
    yard.blocks.push_back({{left, -1}, {left + 0.05, middle - 0.1}});
    yard.blocks.push_back({{left, middle + 0.1}, {left + 0.05, 5}});
  }
  return yard;
}

/// Pairs of points leave a strip in any direction: about 154 nodes, with a standard deviation of 12. Along
/// the strip there would be 21.
inline void gaussianLeavesStrips(rex::grading::Check& check, Student& student, rex::Rng& given) {
  for (const bool rises : {true, false}) {
    const Yard yard = diagonalStrip(rises);
    check.input(fmt::format("a yard blocked except for a strip that {} by 45 degrees; sigma = 0.3 m",
                            rises ? "rises" : "falls"));
    const Samples nodes = gathered(check, given, yard, 2000, 2000, kGaussian,
                                   [&](const auto& rng) { return student.gaussianSample(yard, 0.3, rng); });
    const auto shown =
        check.show([&] { return samplesSeen("Gaussian nodes; wanted: all along the strip", yard, nodes); });
    const auto same =
        check.ask("Do both coordinates get the same normal number? Then q2 lies on one diagonal of q1.");
    check.atLeast("number of nodes of gaussianSample from 2000 attempts", static_cast<double>(nodes.size()),
                  90);
  }
}

// Blocks everywhere except for three slots of that width: along x, along y, and slanted, as stairs of 10
// cm.
inline Yard threeSlots(rex::Rng& rng, double width) {
  const double y = rng.uniform(0.6, 1.4), x = rng.uniform(2.6, 3.4);
  Yard yard{{6, 2},
            {{{0, 0}, {2, y - width / 2}},
             {{0, y + width / 2}, {2, 2}},
             {{2, 0}, {x - width / 2, 2}},
             {{x + width / 2, 0}, {4, 2}}}};
  const double slope = rng.uniform(0.6, 0.8) * (rng.index(2) == 0 ? -1 : 1);
  for (int i = 0; i < 20; ++i) {
    const double left = 4 + 0.1 * i, middle = 1 + slope * (left - 4.95),
                 half = std::hypot(1, slope) * width / 2;
    yard.blocks.push_back({{left, 0}, {left + 0.1, middle - half}});
    yard.blocks.push_back({{left, middle + half}, {left + 0.1, 2}});
  }
  return yard;
}

/// A strip between a block and the border of the yard: one end of the bridge is outside of the yard. The
/// reference finds 102 nodes there, with a standard deviation of 10.
inline void bridgesLeadOutside(rex::grading::Check& check, Student& student, rex::Rng& given) {
  const double sigma = 0.3;
  const Yard yard{{6, 2}, {{{0, 0}, {6, 2 - sigma / 2}}}};
  check.input("a yard of 6 x 2 m, blocked except for a strip of 0.15 m at its upper border; sigma = 0.3 m");
  const auto sample = [&](const auto& rng) { return student.bridgeSample(yard, sigma, rng); };
  attemptsFit(check, given, kBridge, 120, sample);
  const Samples nodes = gathered(check, given, yard, 6000, 6000, kBridge, sample);
  const auto outside = check.ask("May q2 leave the yard? Nothing is free there.");
  check.atLeast("number of nodes of bridgeSample from 6000 attempts", static_cast<double>(nodes.size()), 50);
}

// Over 20 seeds, the reference has shares of 0.33, 0.29 and 0.38, with standard deviations below 0.045.
inline void bridgesFit(rex::grading::Check& check, Student& student, rex::Rng& given) {
  const double sigma = check.rng().uniform(0.25, 0.35);
  const Yard yard = threeSlots(check.rng(), 2 * sigma / 3);
  check.input("a yard of 6 x 2 m, blocked except for three slots: along x, along y and slanted",
              {{"sigma", sigma}});
  const Samples nodes = gathered(check, given, yard, 200, 12000, kBridge,
                                 [&](const auto& rng) { return student.bridgeSample(yard, sigma, rng); });
  const auto shown =
      check.show([&] { return samplesSeen("Bridge nodes; wanted: in all slots", yard, nodes); });
  check.atLeast("number of nodes of bridgeSample from 12000 attempts", static_cast<double>(nodes.size()),
                150);
  check.atLeast("share of the nodes of bridgeSample in the slot along x", share(nodes, {{0, 0}, {2, 2}}),
                0.14);
  check.atLeast("share of the nodes of bridgeSample in the slot along y", share(nodes, {{2, 0}, {4, 2}}),
                0.14);
  check.atLeast("share of the nodes of bridgeSample in the slanted slot", share(nodes, {{4, 0}, {6, 2}}),
                0.14);
}

inline void samplers(rex::grading::Check& check, Student& student) {
  rex::Rng given = generatorsOf(check);
  uniformFits(check, student, given);
  gaussianFits(check, student, given);
  gaussianLeavesStrips(check, student, given);
  bridgesFit(check, student, given);
  bridgesLeadOutside(check, student, given);
  // For a node 3.5 sigma away from all blocks, the ends of its bridge would have to be 7 sigma apart.
  const Yard slot = slotYard(1.9, 0.2);
  check.input("slotYard() of maps.h, 0.2 m wide; sigma = 0.3 m");
  const Samples bridge = gathered(check, given, slot, 60, 6000, kBridge,
                                  [&](const auto& rng) { return student.bridgeSample(slot, 0.3, rng); });
  const auto shown = check.show([&] {
    return samplesSeen("Bridge nodes; wanted: two of five in the slot, none far from blocks", slot, bridge);
  });
  check.atLeast("number of nodes of bridgeSample from 6000 attempts", static_cast<double>(bridge.size()), 10);
  for (const Eigen::Vector2d& q : bridge) {
    double distance = fromBorder(slot, q);
    for (const Block& block : slot.blocks) distance = std::min(distance, (q - nearestPoint(block, q)).norm());
    check.atMost("distance of a node of bridgeSample from the nearest block", distance, 3.5 * 0.3, "m");
  }
  check.atLeast("share of the nodes of bridgeSample in the slot", share(bridge, {{2, 1.9}, {4, 2.1}}), 0.4);
}

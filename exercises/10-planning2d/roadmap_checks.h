#pragma once

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "grid_checks.h"
#include "yard_checks.h"

// The checks of part 4: roadmaps.

// The k nodes nearest to q, leaving out node `self`.
inline std::vector<std::size_t> nearestTo(const std::vector<Eigen::Vector2d>& nodes, const Eigen::Vector2d& q,
                                          int k, std::size_t self) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (i != self) order.emplace_back((nodes[i] - q).norm(), i);
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), static_cast<std::size_t>(k)));
  std::vector<std::size_t> nearest;
  for (const auto& [distance, i] : order) nearest.push_back(i);
  return nearest;
}

// The roadmap that joinNearest() asks for; `with` says what to do with ways for which either answer is
// accepted.
inline Network roadmapOf(const Yard& yard, const std::vector<Eigen::Vector2d>& nodes, int k,
                         double resolution, Straight with) {
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const std::size_t j : nearestTo(nodes, nodes[i], k, i)) {
      const Straight way = judged(yard, nodes[i], nodes[j], resolution);
      if (way == Straight::kFree || way == with) pairs.insert({std::min(i, j), std::max(i, j)});
    }
  Network network(nodes.size());
  for (const auto& [i, j] : pairs) {
    network[i].push_back({j, (nodes[i] - nodes[j]).norm()});
    network[j].push_back({i, (nodes[i] - nodes[j]).norm()});
  }
  return network;
}

inline bool hasArc(const Network& network, std::size_t from, std::size_t to) {
  return std::any_of(network[from].begin(), network[from].end(),
                     [&](const Arc& arc) { return arc.to == to; });
}

/// Whether a network has all arcs of `least`, and none that `all` has not.
inline bool isBetween(const Network& network, const Network& least, const Network& all) {
  for (std::size_t i = 0; i < network.size(); ++i) {
    const auto isIn = [i](const Network& other) {
      return [&other, i](const Arc& arc) { return hasArc(other, i, arc.to); };
    };
    if (!std::all_of(network[i].begin(), network[i].end(), isIn(all))) return false;
    if (!std::all_of(least[i].begin(), least[i].end(), isIn(network))) return false;
  }
  return true;
}

/// The nodes at the ends of an arc.
struct ArcEnds {
  std::size_t from = 0, to = 0;
};

// Checks that no necessary arc is missing, and that there are no others than the possible ones. `here` is
// the arc being checked.
inline void isRoadmap(rex::grading::Check& check, const Yard& yard, const std::vector<Eigen::Vector2d>& nodes,
                      int k, double resolution, const Network& got, ArcEnds& here) {
  const auto roadmapWith = [&](int others, Straight with) {
    return roadmapOf(yard, nodes, others, resolution, with);
  };
  const Network all = roadmapWith(k, Straight::kEither), least = roadmapWith(k, Straight::kFree);
  check.near("number of lists of arcs of joinNearest", static_cast<double>(got.size()),
             static_cast<double>(nodes.size()), 0);
  const auto holds = [&](const char* property, bool isTrue) {
    holdsWhere(check, property, isTrue, fmt::format("arc from node {} to node {}", here.from, here.to));
  };
  for (std::size_t i = 0; i < got.size(); ++i) {
    std::set<std::size_t> ends;
    for (const auto& [to, length] : got[i]) {
      here = {i, to};
      holds("every arc of joinNearest leads to a node", to < nodes.size());
      holds("no arc of joinNearest is there twice", ends.insert(to).second);
      holds("every arc of joinNearest leads along a free way",
            judged(yard, nodes[i], nodes[to], resolution) != Straight::kBlocked);
      holds("every arc of joinNearest joins a node and one of its k nearest", hasArc(all, i, to));
      holds("every arc of joinNearest has one that leads back", hasArc(got, to, i));
      check.near("length of an arc of joinNearest", length, (nodes[i] - nodes[to]).norm(), 1e-9, "m");
    }
  }
  const auto self =
      check.ask("Is the node itself counted as one of its k nearest?",
                isBetween(got, roadmapWith(k - 1, Straight::kFree), roadmapWith(k - 1, Straight::kEither)));
  for (std::size_t i = 0; i < got.size(); ++i)
    for (const Arc& arc : least[i]) {
      here = {i, arc.to};
      holds("joinNearest joins each node and its k nearest wherever the way is free", hasArc(got, i, arc.to));
    }
}

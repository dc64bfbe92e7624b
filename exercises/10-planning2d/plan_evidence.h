#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "drawing.h"
#include "grading/evidence.h"
#include "grid_checks.h"
#include "render/figure_builders.h"
#include "roadmap_checks.h"
#include "yard_checks.h"

// What the checks show if ways, maps or yards are wrong.

using Points = std::vector<Eigen::Vector2d>;

/// Numbers of the cells beside the wanted ones, with a ring at the one being checked.
inline rex::grading::Evidence wavesSeen(const CellMap& map, MapCell goal, const std::vector<int>& got,
                                        const std::vector<int>& wanted, MapCell here) {
  if (got.size() != wanted.size()) return {};
  std::vector<rex::Figure> figures;
  for (const auto& [title, numbers] : {std::pair{"Wave, got", &got}, {"Wave, wanted", &wanted}}) {
    rex::Figure figure = planOf(title, map);
    figure.legend = rex::Legend::kNone;
    addNumbers(figure, map, "number", {numbers->begin(), numbers->end()}, 0);
    figure.colorRange = rex::AxisRange(0, 1. + *std::max_element(wanted.begin(), wanted.end()));
    addLine(figure, {centerOf(goal)}, dots("", kBlack, 2));
    figure.series.push_back(rex::grading::wrongPoint("", centerOf(here).x(), centerOf(here).y()));
    figures.push_back(std::move(figure));
  }
  return {.figures = std::move(figures)};
}

inline bool hasSameArc(const Network& network, std::size_t from, const Arc& wanted) {
  return from < network.size() &&
         std::any_of(network[from].begin(), network[from].end(), [&](const Arc& arc) {
           return arc.to == wanted.to && std::abs(arc.length - wanted.length) < 1e-9;
         });
}

/// Arcs of one network that another does not have, or not as long, as lines between the positions of nodes.
inline void addExtraArcs(rex::Figure& figure, const Points& places, const Network& network,
                         const Network& other, const rex::Series& look) {
  std::string label = look.label;
  for (std::size_t from = 0; from < std::min(network.size(), places.size()); ++from)
    for (const Arc& arc : network[from]) {
      if (arc.to >= places.size() || hasSameArc(other, from, arc)) continue;
      rex::Series line = look;
      line.label = std::exchange(label, "");
      addLine(figure, {places[from], places[arc.to]}, line);
    }
}

/// A network over a plan: the arcs that should not be there, those of `least` that are missing, and a ring
/// around the first node of the arc being checked.
inline rex::grading::Evidence networkSeen(rex::Figure figure, const Points& places, const Network& got,
                                          const Network& all, const Network& least, const ArcEnds& here) {
  addExtraArcs(figure, places, got, {}, {.label = "got", .size = 0.5, .color = kGray});
  addExtraArcs(figure, places, got, all, rex::grading::wrongCurve("got, not wanted"));
  addExtraArcs(figure, places, least, got, rex::grading::wantedCurve("wanted, missing"));
  addLine(figure, places, dots("", kBlack, .6));
  if (here.from >= places.size()) return {.figures = {figure}};
  if (here.to < places.size())
    addLine(figure, {places[here.from], places[here.to]},
            {.label = "the arc in question", .size = 4, .color = rex::Color{.84f, .37f, 0}});
  figure.series.push_back(
      rex::grading::wrongPoint("from this node", places[here.from].x(), places[here.from].y()));
  return {.figures = {figure}};
}

/// A shortest path by the distances from its end; without arcs in the sum, each step goes to the lowest node.
inline std::vector<std::size_t> steepestWay(const Network& network, const std::vector<double>& distances,
                                            std::size_t start, double weight = 1) {
  std::vector<std::size_t> way{start};
  while (std::isfinite(distances[start]) && distances[way.back()] > 0 && way.size() <= network.size()) {
    const auto& arcs = network.at(way.back());
    const auto costs = [&](const Arc& arc) { return weight * arc.length + distances[arc.to]; };
    way.push_back(std::min_element(arcs.begin(), arcs.end(), [&](const Arc& a, const Arc& b) {
                    return costs(a) < costs(b);
                  })->to);
  }
  return way;
}

/// A way over a network between positions, beside a shortest one.
inline rex::grading::Evidence waySeen(const RandomNetwork& made, const std::vector<std::size_t>& got,
                                      const std::vector<std::size_t>& wanted) {
  rex::Figure figure = planOf("A way over a network", {1, 1}, {});
  const auto placesOf = [&](const std::vector<std::size_t>& way) {
    Points points;
    for (const std::size_t node : way)
      if (node < made.places.size()) points.push_back(made.places[node]);
    return points;
  };
  addExtraArcs(figure, made.places, made.network, {}, {.label = "network", .size = 0.3, .color = kGray});
  addLine(figure, placesOf(got), rex::grading::gotCurve("got"));
  addLine(figure, placesOf(wanted), rex::grading::wantedCurve("wanted"));
  addLine(figure, placesOf({wanted.front()}), dots("start", kBlack, 2));
  return {.figures = {figure}};
}

/// A straight way in a yard, and the wanted answer.
inline rex::grading::Evidence straightSeen(const Yard& yard, const Eigen::Vector2d& a,
                                           const Eigen::Vector2d& b, Straight wanted) {
  rex::Figure figure = planOf(
      wanted == Straight::kFree ? "The straight way; wanted: free" : "The straight way; wanted: blocked",
      yard.size, yard.blocks);
  addLine(figure, {a, b}, {.label = "way", .size = 2, .color = rex::grading::kGotColor});
  return {.figures = {figure}};
}

/// The distances of Gaussian nodes from a wall, in sigmas, and their density, which is proportional to the
/// probability of a normal number beyond.
inline rex::Figure distancesSeen(const std::vector<double>& distances) {
  rex::Histogram bars = normalized(rex::sampleHistogram(distances, 20));
  bars.label = "got";
  rex::Series density = rex::grading::wantedCurve("wanted");
  for (double x = 0; x <= 3.5; x += .05) density.add(x, std::sqrt(M_PI / 2) * std::erfc(x / std::sqrt(2)));
  return {.title = "How far Gaussian nodes are from the wall",
          .xLabel = "distance [sigma]",
          .yLabel = "density [1/sigma]",
          .series = {density},
          .histograms = {bars}};
}

/// Nodes of a sampler in its yard.
inline rex::grading::Evidence samplesSeen(const std::string& title, const Yard& yard, const Points& samples) {
  rex::Figure figure = planOf(title, yard.size, yard.blocks);
  addLine(figure, samples, dots("got", rex::grading::kGotColor, .6));
  return {.figures = {figure}};
}

/// A path on a map with the cells whose arcs were asked for; `tooFar` are those that no shortest path needs.
inline rex::grading::Evidence searchSeen(const CellMap& map, const std::vector<std::size_t>& got,
                                         const std::vector<std::size_t>& asked,
                                         const std::vector<std::size_t>& tooFar,
                                         const std::vector<std::size_t>& wanted) {
  rex::Figure figure = planOf("A search on a map", map);
  addLine(figure, centersOf(map, asked), dots("asked for", {.5f, .7f, .9f}, 1.5, rex::Marker::kSquare));
  addLine(figure, centersOf(map, tooFar), dots("asked for, but not needed", rex::grading::kWrongColor, 1.5));
  addLine(figure, centersOf(map, got), rex::grading::gotCurve("got"));
  addLine(figure, centersOf(map, wanted), rex::grading::wantedCurve("wanted, or as long"));
  return {.figures = {figure}};
}

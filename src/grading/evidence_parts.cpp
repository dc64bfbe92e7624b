#include "grading/evidence_parts.h"

#include <algorithm>
#include <utility>

namespace rex::grading {
namespace {

constexpr Color kPale{0.0f, 0.62f, 0.45f, 0.4f}, kPaleLine{0.0f, 0.62f, 0.45f};

bool isSame(const Solid& a, const Solid& b) {
  constexpr double kTolerance = 1e-9;
  return a.name == b.name && isApprox(a.X_WS, b.X_WS, kTolerance);
}

void appendSolids(std::vector<Solid>& to, const std::vector<Solid>& solids) {
  const std::size_t count = to.size();
  for (std::size_t i = 0; i < solids.size(); ++i) {
    if (i < count && isSame(to[i], solids[i])) continue;
    to.push_back(solids[i]);
    to.back().color = kPale;
  }
}

template <class Part>
void append(std::vector<Part>& to, const std::vector<Part>& parts) {
  for (const Part& part : parts) {
    to.push_back(part);
    to.back().color = kPaleLine;
  }
}

}  // namespace

Series gotCurve(std::string label, std::vector<double> x, std::vector<double> y) {
  return {.label = std::move(label), .x = std::move(x), .y = std::move(y), .size = 2.5, .color = kGotColor};
}

Series wantedCurve(std::string label, std::vector<double> x, std::vector<double> y) {
  return {
      .label = std::move(label), .x = std::move(x), .y = std::move(y), .dashed = true, .color = kWantedColor};
}

Series wrongCurve(std::string label, std::vector<double> x, std::vector<double> y) {
  return {.label = std::move(label), .x = std::move(x), .y = std::move(y), .size = 2, .color = kWrongColor};
}

Series wrongPoint(std::string label, double x, double y) {
  return {.label = std::move(label),
          .x = {x},
          .y = {y},
          .style = SeriesStyle::kPoints,
          .marker = Marker::kCircle,
          .size = 2.5,
          .color = kWrongColor};
}

Guide wrongFrom(double time) { return {.at = time, .label = "it goes wrong here", .color = kWrongColor}; }

Picture withWanted(Picture got, const Picture& wanted) {
  appendSolids(got.solids, wanted.solids);
  append(got.polylines, wanted.polylines);
  append(got.lineSets, wanted.lineSets);
  append(got.pointSets, wanted.pointSets);
  append(got.arrows, wanted.arrows);
  got.captions.push_back({.text = "wanted: pale green", .color = kPaleLine});
  return got;
}

Film withWanted(const Film& got, const Film& wanted) {
  if (got.empty() || wanted.empty()) return got;
  Film film = got.size() < wanted.size() ? wanted : got;
  for (std::size_t i = 0; i < film.size(); ++i)
    film[i].picture =
        withWanted(got[std::min(i, got.size() - 1)].picture, wanted[std::min(i, wanted.size() - 1)].picture);
  return film;
}

}  // namespace rex::grading

#pragma once

#include <string>
#include <vector>

#include "render/figure.h"
#include "render/film.h"

namespace rex::grading {

// The colours of evidence: the result, what was wanted, and where it went wrong. They can be told apart
// with any kind of colour vision.
inline constexpr Color kGotColor{0.0f, 0.45f, 0.7f}, kWantedColor{0.20f, 0.22f, 0.26f},
    kWrongColor{0.80f, 0.10f, 0.12f};

/// The curve of a result: thick and blue.
[[nodiscard]] Series gotCurve(std::string label, std::vector<double> x = {}, std::vector<double> y = {});
/// The curve that was wanted: dashed and dark, drawn over the other.
[[nodiscard]] Series wantedCurve(std::string label, std::vector<double> x = {}, std::vector<double> y = {});
/// The part of a curve that went wrong: red and thick.
[[nodiscard]] Series wrongCurve(std::string label, std::vector<double> x = {}, std::vector<double> y = {});
/// A ring around a point where something went wrong.
[[nodiscard]] Series wrongPoint(std::string label, double x, double y);

/// A curve through points of the plane, or through the first two numbers of poses.
template <class Points>
[[nodiscard]] Series through(const Points& points, Series curve) {
  for (const auto& point : points) {
    curve.x.push_back(point[0]);
    curve.y.push_back(point[1]);
  }
  return curve;
}

/// A vertical line where a motion goes wrong.
[[nodiscard]] Guide wrongFrom(double time);

/// The result with the wanted picture drawn into it: solids in translucent green, lines in green, explained
/// by a caption. Solids that are the same in both are drawn once.
[[nodiscard]] Picture withWanted(Picture got, const Picture& wanted);
/// The same for every frame. After the end of the shorter film its last picture stays. Times are those of
/// the longer film.
[[nodiscard]] Film withWanted(const Film& got, const Film& wanted);

}  // namespace rex::grading

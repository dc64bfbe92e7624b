#include "render/text.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "render/glyphs_internal.h"
#include "render/utf8_internal.h"

namespace rex {
namespace {

using Eigen::Vector2d;

// Pixels per unit of the glyph table at scale 1, such that stems and the lines of capitals fall on whole
// pixels.
constexpr double kUnitX = 1.25, kUnitY = 1.5;
constexpr double kHalfStroke = 0.65, kEdge = 1.6;  // pixels at scale 1
constexpr double kGap = 2.0, kSpace = 3.0;         // units between characters, of a space
constexpr double kTop = 9.5, kBottom = -0.5;       // units: the vertical extent of a line of text

struct Segment {
  Vector2d a, b;
};

// Quadratic B-spline: parabolas between the middles of the control polygon's sides.
void addCurve(const std::vector<Vector2d>& control, bool closed, std::vector<Segment>& segments) {
  constexpr int kSteps = 6;
  const std::size_t n = control.size();
  const std::size_t first = closed ? 0 : 1, last = closed ? n : n - 1;
  for (std::size_t i = first; i < last; ++i) {
    const Vector2d& before = control[(i + n - 1) % n];
    const Vector2d& middle = control[i];
    const Vector2d& after = control[(i + 1) % n];
    const Vector2d from = !closed && i == 1 ? before : Vector2d((before + middle) / 2);
    const Vector2d to = !closed && i + 2 == n ? after : Vector2d((middle + after) / 2);
    Vector2d previous = from;
    for (int k = 1; k <= kSteps; ++k) {
      const double t = static_cast<double>(k) / kSteps;
      const Vector2d next = (1 - t) * (1 - t) * from + 2 * t * (1 - t) * middle + t * t * to;
      segments.push_back({previous, next});
      previous = next;
    }
  }
}

// The strokes of a character as line segments in table units.
std::vector<Segment> segmentsOf(char32_t character) {
  std::vector<Segment> segments;
  std::string_view rest = internal::glyphStrokes(character);
  while (!rest.empty()) {
    const std::string_view stroke = rest.substr(0, rest.find(' '));
    rest.remove_prefix(std::min(stroke.size() + 1, rest.size()));
    std::vector<Vector2d> points;
    for (std::size_t k = 1; k + 1 < stroke.size(); k += 2)
      points.emplace_back(stroke[k] - '0', stroke[k + 1] - '0');
    const char kind = stroke[0];
    if (kind == '~' || kind == 'o') addCurve(points, kind == 'o', segments);
    if (kind == '.') segments.push_back({points[0], points[0] + Vector2d(0, 0.3)});
    for (std::size_t k = 0; kind == '-' && k + 1 < points.size(); ++k)
      segments.push_back({points[k], points[k + 1]});
  }
  return segments;
}

double widthOf(const std::vector<Segment>& segments) {
  double width = segments.empty() ? kSpace - kGap : 0;
  for (const Segment& s : segments) width = std::max({width, s.a.x(), s.b.x()});
  return width;
}

double distance(const Vector2d& point, const Segment& s) {
  const Vector2d side = s.b - s.a, from = point - s.a;
  const double length2 = side.squaredNorm();
  const double t = length2 > 0 ? std::clamp(from.dot(side) / length2, 0.0, 1.0) : 0;
  return (from - t * side).norm();
}

struct PlacedGlyph {
  std::vector<Segment> segments;  // pixels of the image
};

// Where the strokes of a line of text go, and how wide it is.
struct Layout {
  std::vector<PlacedGlyph> glyphs;
  double width = 0;
};

Layout layOut(std::string_view text, double x, double y, double scale) {
  Layout layout;
  for (const char32_t character : internal::charactersOf(text)) {
    PlacedGlyph glyph{segmentsOf(character)};
    const double advance = std::round((widthOf(glyph.segments) + kGap) * kUnitX * scale);
    for (Segment& s : glyph.segments)
      for (Vector2d* p : {&s.a, &s.b})
        *p = {x + layout.width + kGap / 2 * kUnitX * scale + p->x() * kUnitX * scale,
              y + (kTop - p->y()) * kUnitY * scale};
    layout.width += advance;
    layout.glyphs.push_back(std::move(glyph));
  }
  return layout;
}

// Covers the pixels within `reach` of the strokes, with a soft border of one pixel.
void paint(Image& image, const PlacedGlyph& glyph, double reach, const Color& color) {
  Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const Segment& s : glyph.segments) {
    low = low.cwiseMin(s.a).cwiseMin(s.b);
    high = high.cwiseMax(s.a).cwiseMax(s.b);
  }
  const int x0 = std::max(0, static_cast<int>(low.x() - reach - 1));
  const int y0 = std::max(0, static_cast<int>(low.y() - reach - 1));
  const int x1 = std::min(image.width - 1, static_cast<int>(high.x() + reach + 1));
  const int y1 = std::min(image.height - 1, static_cast<int>(high.y() + reach + 1));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      double nearest = 1e9;
      for (const Segment& s : glyph.segments) nearest = std::min(nearest, distance({x + 0.5, y + 0.5}, s));
      const double cover = std::clamp(reach + 0.5 - nearest, 0.0, 1.0) * color.a;
      std::uint8_t* pixel = image.pixel(x, y);
      const float parts[3] = {color.r, color.g, color.b};
      for (int c = 0; c < 3; ++c)
        pixel[c] = static_cast<std::uint8_t>(
            std::lround((1 - cover) * pixel[c] + cover * 255 * std::clamp(parts[c], 0.f, 1.f)));
    }
  }
}

}  // namespace

TextSize textSize(std::string_view text, double scale) {
  return {static_cast<int>(layOut(text, 0, 0, scale).width),
          static_cast<int>(std::ceil((kTop - kBottom) * kUnitY * scale))};
}

void drawText(Image& image, std::string_view text, int x, int y, const Color& color, double scale) {
  // Half a pixel puts the middle of upright strokes into the middle of pixels.
  const Layout layout = layOut(text, x + 0.5, y + 0.5, scale);
  const double brightness = 0.3 * color.r + 0.6 * color.g + 0.1 * color.b;
  const Color edge = brightness < 0.6 ? Color{1, 1, 1, 0.75f * color.a} : Color{0, 0, 0, 0.6f * color.a};
  const double halfStroke = kHalfStroke * scale;
  for (const PlacedGlyph& glyph : layout.glyphs) paint(image, glyph, halfStroke + kEdge, edge);
  for (const PlacedGlyph& glyph : layout.glyphs) paint(image, glyph, halfStroke, color);
}

}  // namespace rex

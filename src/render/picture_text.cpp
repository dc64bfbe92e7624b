#include <string_view>
#include <vector>

#include "render/picture_text_internal.h"
#include "render/text.h"

namespace rex::internal {
namespace {

constexpr int kMargin = 8;  // pixels between text and what it stands beside

// `lower` is how many pixels below its point the text stands.
void drawLabel(Image& image, const Label& label, int lower, const Camera& camera) {
  const auto at = project(camera, label.p_WQ, image.width, image.height);
  if (!at || label.text.empty()) return;
  if (at->x < 0 || at->y < 0 || at->x >= image.width || at->y >= image.height) return;
  // To the right of the point, or to the left where the picture ends.
  const TextSize size = textSize(label.text, label.scale);
  const int right = static_cast<int>(at->x) + kMargin;
  const int x = right + size.width <= image.width ? right : static_cast<int>(at->x) - kMargin - size.width;
  drawText(image, label.text, x, static_cast<int>(at->y) + lower - size.height / 2, label.color, label.scale);
}

std::vector<std::string_view> linesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  for (;;) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return lines;
    text.remove_prefix(end + 1);
  }
}

int heightOf(const Caption& caption) {
  return static_cast<int>(linesOf(caption.text).size()) * textSize("", caption.scale).height;
}

void drawCaption(Image& image, const Caption& caption, int top) {
  const bool left = caption.corner == Corner::kTopLeft || caption.corner == Corner::kBottomLeft;
  for (const std::string_view line : linesOf(caption.text)) {
    const TextSize size = textSize(line, caption.scale);
    drawText(image, line, left ? kMargin : image.width - kMargin - size.width, top, caption.color,
             caption.scale);
    top += size.height;
  }
}

}  // namespace

void drawPictureText(Image& image, const Picture& picture, const Camera& camera) {
  // Below the origin, the name of a frame stays clear of its axes as long as z points up.
  constexpr int kNameBelow = 10;  // pixels
  for (const Axes& axes : picture.axes)
    drawLabel(image, {.text = axes.name, .p_WQ = axes.X_WF.p}, kNameBelow, camera);
  for (const Label& label : picture.labels) drawLabel(image, label, 0, camera);

  for (const Corner corner :
       {Corner::kTopLeft, Corner::kTopRight, Corner::kBottomLeft, Corner::kBottomRight}) {
    const bool bottom = corner == Corner::kBottomLeft || corner == Corner::kBottomRight;
    int top = kMargin;
    for (const Caption& caption : picture.captions)
      if (bottom && caption.corner == corner) top -= heightOf(caption);
    if (bottom) top += image.height - 2 * kMargin;
    for (const Caption& caption : picture.captions) {
      if (caption.corner != corner) continue;
      drawCaption(image, caption, top);
      top += heightOf(caption);
    }
  }
}

}  // namespace rex::internal

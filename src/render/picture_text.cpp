#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "render/picture_text_internal.h"
#include "render/text.h"
#include "render/text_internal.h"

namespace rex::internal {
namespace {

constexpr int kRounds = 8;

// Positions around the point, best first: each round moves one line of text farther up and down, and
// finally one width farther to the sides, too.
std::vector<PixelBox> candidates(const LabelWish& wish) {
  const int beside = wish.y + wish.lower - wish.height / 2;
  const int above = wish.y - kTextMargin - wish.height, below = wish.y + wish.lower + kTextMargin;
  std::vector<PixelBox> boxes;
  const auto add = [&](int x, int y) { boxes.push_back({x, y, wish.width, wish.height}); };
  for (const int farther : {0, wish.width}) {
    const int right = wish.x + kTextMargin + farther, left = wish.x - kTextMargin - wish.width - farther;
    for (int round = 0; round < kRounds; ++round) {
      const int shift = round * wish.height;
      add(right, beside - shift);
      add(right, beside + shift);
      add(left, beside - shift);
      add(left, beside + shift);
      add(wish.x - wish.width / 2, above - shift);
      add(wish.x - wish.width / 2, below + shift);
    }
  }
  return boxes;
}

bool meet(const PixelBox& a, const PixelBox& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

}  // namespace

std::vector<PixelBox> placeLabels(const std::vector<LabelWish>& wishes, std::vector<PixelBox> taken,
                                  int width, int height) {
  const auto isInside = [&](const PixelBox& box) {
    return box.x >= 0 && box.y >= 0 && box.x + box.width <= width && box.y + box.height <= height;
  };
  const auto isFree = [&](const PixelBox& box) {
    return isInside(box) &&
           std::none_of(taken.begin(), taken.end(), [&](const PixelBox& other) { return meet(box, other); });
  };
  std::vector<PixelBox> places;
  for (const LabelWish& wish : wishes) {
    const std::vector<PixelBox> boxes = candidates(wish);
    auto place = std::find_if(boxes.begin(), boxes.end(), isFree);
    if (place == boxes.end()) place = std::find_if(boxes.begin(), boxes.end(), isInside);
    if (place == boxes.end()) place = boxes.begin();
    places.push_back(*place);
    taken.push_back(*place);
  }
  return places;
}

namespace {

// A line of text at its position.
struct PlacedText {
  std::string_view text;
  PixelBox box;
  Color color;
  double scale;
};

struct SeenLabel {
  const Label* label;
  LabelWish wish;
  double depth;
};

int heightOf(const Caption& caption) {
  return static_cast<int>(linesOf(caption.text).size()) * textSize("", caption.scale).height;
}

std::vector<PlacedText> placeCaptions(const std::vector<Caption>& captions, const Image& image) {
  std::vector<PlacedText> texts;
  for (const Corner corner :
       {Corner::kTopLeft, Corner::kTopRight, Corner::kBottomLeft, Corner::kBottomRight}) {
    const bool bottom = corner == Corner::kBottomLeft || corner == Corner::kBottomRight;
    const bool left = corner == Corner::kTopLeft || corner == Corner::kBottomLeft;
    int top = kTextMargin;
    for (const Caption& caption : captions)
      if (bottom && caption.corner == corner) top -= heightOf(caption);
    if (bottom) top += image.height - 2 * kTextMargin;
    for (const Caption& caption : captions) {
      if (caption.corner != corner) continue;
      for (const std::string_view line : linesOf(caption.text)) {
        const TextSize size = textSize(line, caption.scale);
        const int x = left ? kTextMargin : image.width - kTextMargin - size.width;
        texts.push_back({line, {x, top, size.width, size.height}, caption.color, caption.scale});
        top += size.height;
      }
    }
  }
  return texts;
}

// The labels whose points are in the picture, the nearest first: they choose their positions first.
std::vector<SeenLabel> seenLabels(const std::vector<Label>& labels, const Image& image, const Camera& camera,
                                  int lower) {
  std::vector<SeenLabel> seen;
  for (const Label& label : labels) {
    const auto at = project(camera, label.p_WQ, image.width, image.height);
    if (!at || label.text.empty()) continue;
    if (at->x < 0 || at->y < 0 || at->x >= image.width || at->y >= image.height) continue;
    const TextSize size = textSize(label.text, label.scale);
    seen.push_back({&label,
                    {static_cast<int>(at->x), static_cast<int>(at->y), size.width, size.height, lower},
                    at->depth});
  }
  return seen;
}

}  // namespace

void drawPictureText(Image& image, const Picture& picture, const Camera& camera) {
  // Below the origin, the name of a frame stays clear of its axes as long as z points up.
  constexpr int kNameBelow = 10;  // pixels
  std::vector<Label> names;
  for (const Axes& axes : picture.axes) names.push_back({.text = axes.name, .p_WQ = axes.X_WF.p});
  std::vector<SeenLabel> seen = seenLabels(names, image, camera, kNameBelow);
  const std::vector<SeenLabel> labels = seenLabels(picture.labels, image, camera, 0);
  seen.insert(seen.end(), labels.begin(), labels.end());
  std::stable_sort(seen.begin(), seen.end(),
                   [](const SeenLabel& a, const SeenLabel& b) { return a.depth < b.depth; });

  const std::vector<PlacedText> captions = placeCaptions(picture.captions, image);
  std::vector<PixelBox> taken;
  for (const PlacedText& text : captions) taken.push_back(text.box);
  std::vector<LabelWish> wishes;
  for (const SeenLabel& one : seen) wishes.push_back(one.wish);
  const std::vector<PixelBox> boxes = placeLabels(wishes, taken, image.width, image.height);

  for (std::size_t i = seen.size(); i-- > 0;)
    drawText(image, seen[i].label->text, boxes[i].x, boxes[i].y, seen[i].label->color, seen[i].label->scale);
  for (const PlacedText& text : captions)
    drawText(image, text.text, text.box.x, text.box.y, text.color, text.scale);
}

}  // namespace rex::internal

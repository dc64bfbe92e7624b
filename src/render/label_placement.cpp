#include <algorithm>

#include "render/label_placement_internal.h"

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

}  // namespace rex::internal

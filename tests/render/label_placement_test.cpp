#include <gtest/gtest.h>

#include "base/rng.h"
#include "render/picture_text_internal.h"

namespace rex::internal::label_placement_test {

constexpr int kWidth = 320, kHeight = 240;

bool meet(const PixelBox& a, const PixelBox& b) {
  return std::max(a.x, b.x) < std::min(a.x + a.width, b.x + b.width) &&
         std::max(a.y, b.y) < std::min(a.y + a.height, b.y + b.height);
}

void expectApart(const std::vector<PixelBox>& boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_GE(boxes[i].x, 0);
    EXPECT_GE(boxes[i].y, 0);
    EXPECT_LE(boxes[i].x + boxes[i].width, kWidth);
    EXPECT_LE(boxes[i].y + boxes[i].height, kHeight);
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(meet(boxes[i], boxes[k])) << i << ' ' << k;
  }
}

TEST(PlaceLabels, PutsTwoAtOnePointToTheRightAndLeft) {
  const LabelWish wish{.x = 160, .y = 120, .width = 40, .height = 16};
  const auto boxes = placeLabels({wish, wish}, {}, kWidth, kHeight);
  EXPECT_EQ(boxes[0], (PixelBox{168, 112, 40, 16}));
  EXPECT_EQ(boxes[1], (PixelBox{112, 112, 40, 16}));
}

TEST(PlaceLabels, StaysInThePicture) {
  const auto place = [](int x, int y, int lower = 0) {
    return placeLabels({{x, y, 60, 16, lower}}, {}, kWidth, kHeight)[0];
  };
  EXPECT_EQ(place(300, 120).x, 300 - 8 - 60) << "left of a point at the right border";
  EXPECT_EQ(place(5, 120).x, 13);
  EXPECT_EQ(place(160, 2).y, 10) << "below a point at the upper border";
  EXPECT_EQ(place(160, 238).y, 238 - 8 - 16);
  EXPECT_EQ(place(160, 120, 10).y, 122);
  for (const int x : {0, kWidth - 1})
    for (const int y : {0, kHeight - 1}) expectApart({place(x, y)});
}

TEST(PlaceLabels, KeepsTwentyInACrowdApart) {
  const std::vector<PixelBox> captions = {{8, 8, 200, 32}, {100, 100, 60, 16}};
  const std::vector<LabelWish> same(20, {.x = 160, .y = 120, .width = 30, .height = 16});
  auto boxes = placeLabels(same, captions, kWidth, kHeight);
  for (const PixelBox& box : boxes) {
    EXPECT_LT(std::abs(box.x + box.width / 2 - 160), 70) << "near its point";
    EXPECT_LT(std::abs(box.y + box.height / 2 - 120), 140);
  }
  boxes.insert(boxes.end(), captions.begin(), captions.end());
  expectApart(boxes);

  Rng rng(2);
  std::vector<LabelWish> crowd;
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd at = rng.uniformVector(2, 60, 180);
    crowd.push_back({static_cast<int>(at[0]), static_cast<int>(at[1]), 40, 14, 0});
  }
  expectApart(placeLabels(crowd, {}, kWidth, kHeight));
}

TEST(PlaceLabels, OverlapsRatherThanLeavesOut) {
  const PixelBox everything{0, 0, kWidth, kHeight};
  const LabelWish wish{.x = 300, .y = 120, .width = 40, .height = 16};
  EXPECT_EQ(placeLabels({wish}, {everything}, kWidth, kHeight)[0].x, 252);
  const LabelWish huge{.x = 10, .y = 120, .width = 1000, .height = 16};
  EXPECT_EQ(placeLabels({huge}, {}, kWidth, kHeight)[0].x, 18);
}

}  // namespace rex::internal::label_placement_test

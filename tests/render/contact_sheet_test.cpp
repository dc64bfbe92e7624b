#include "render/contact_sheet.h"

#include <gtest/gtest.h>

#include "render/image.h"
#include "support/expect_error.h"
#include "support/test_frames.h"

namespace rex::contact_sheet_test {

TEST(Shrunk, TakesTheMeanOfWhatAPixelCovers) {
  Rng rng(3);
  const Image image = noise(12, 8, rng);
  const Image half = shrunk(image, 6);
  ASSERT_EQ(half.width, 6);
  ASSERT_EQ(half.height, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 6; ++x) {
      for (int c = 0; c < 3; ++c) {
        const int sum = image.pixel(2 * x, 2 * y)[c] + image.pixel(2 * x + 1, 2 * y)[c] +
                        image.pixel(2 * x, 2 * y + 1)[c] + image.pixel(2 * x + 1, 2 * y + 1)[c];
        EXPECT_NEAR(half.pixel(x, y)[c], sum / 4., 0.51);
      }
    }
  }
  Image three(3, 1);
  for (int x = 0; x < 3; ++x) three.pixel(x, 0)[0] = static_cast<std::uint8_t>(30 * x);
  EXPECT_EQ(shrunk(three, 2).at(0, 0)[0], 10);  // (0 + 30 / 2) / 1.5
  EXPECT_EQ(shrunk(three, 2).at(1, 0)[0], 50);
}

TEST(Shrunk, KeepsPlainColoursAndSmallImages) {
  const Image plain = plainImage(641, 479, {10, 128, 255});
  EXPECT_EQ(shrunk(plain, 97), plainImage(97, 72, {10, 128, 255}));
  EXPECT_EQ(shrunk(plain, 641), plain);
  EXPECT_REX_ERROR(shrunk(plain, 0), "image size: found 0 x 1");
}

TEST(KeyFrames, AreEvenWithBothEnds) {
  using Indices = std::vector<std::size_t>;
  EXPECT_EQ(keyFrames(101, 6), (Indices{0, 20, 40, 60, 80, 100}));
  EXPECT_EQ(keyFrames(3, 6), (Indices{0, 1, 2}));
  EXPECT_EQ(keyFrames(1, 6), Indices{0});
  EXPECT_EQ(keyFrames(0, 6), Indices());
}

constexpr int kWidth = 32, kHeight = 24;

// Frame number i tells its number by its colour.
Image numbered(int i) { return plainImage(kWidth, kHeight, {i / 256, i % 256, 77}); }

// Where pictures lie: 10 pixels apart across; a line of text more from row to row.
std::vector<int> numbersOn(const Image& sheet, int columns) {
  const int right = kWidth + 10;
  EXPECT_EQ((sheet.width - 10) % right, 0);
  std::vector<int> numbers;
  for (int y = 10; y < sheet.height; ++y) {
    if (sheet.at(10, y)[2] != 77 || sheet.at(10, y - 1)[2] == 77) continue;
    for (int k = 0; k < columns && 10 + k * right < sheet.width; ++k) {
      const std::array<int, 3> color = sheet.at(10 + k * right, y);
      if (color[2] == 77) numbers.push_back(256 * color[0] + color[1]);
    }
  }
  return numbers;
}

TEST(ContactSheet, ShowsAllPicturesInRows) {
  std::vector<KeyFrame> frames;
  for (int i = 0; i < 5; ++i) frames.push_back({numbered(i), "a caption that is longer than its picture"});
  const Image sheet = contactSheet(frames, {.columns = 2});
  EXPECT_EQ(sheet.width, 2 * 42 + 10);
  EXPECT_EQ(numbersOn(sheet, 2), (std::vector{0, 1, 2, 3, 4}));
  const Image silent = contactSheet(std::vector<KeyFrame>(5, {numbered(0), ""}), {.columns = 2});
  EXPECT_NE(sheet, silent) << "captions";
  EXPECT_EQ(sheet.at(sheet.width - 1, sheet.height - 1), (std::array{255, 255, 255}));
}

TEST(ContactSheet, RefusesNonsense) {
  EXPECT_REX_ERROR(contactSheet({}), "a contact sheet without pictures");
  const std::vector<KeyFrame> one(1, {numbered(0), ""});
  EXPECT_REX_ERROR(contactSheet(one, {.pictures = 1}), "contact sheet: pictures: found 1, wanted at least 2");
  EXPECT_REX_ERROR(contactSheet(one, {.columns = 0}), "contact sheet: columns: found 0, wanted at least 1");
  EXPECT_REX_ERROR(contactSheet(one, {.pictureWidth = 3}),
                   "contact sheet: width of a picture: found 3, wanted at least 16");
}

}  // namespace rex::contact_sheet_test

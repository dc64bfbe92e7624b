#include "render/image.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <zlib.h>

#include "base/rng.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/fresh_folder.h"

namespace rex::image_test {

namespace fs = std::filesystem;

Image noise(int width, int height) {
  Rng rng(7);
  Image image(width, height);
  for (std::uint8_t& byte : image.rgb) byte = static_cast<std::uint8_t>(rng.index(256));
  return image;
}

// Smooth areas with a few edges, like our pictures.
Image scenery(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool inside = (x - 200) * (x - 200) + (y - 200) * (y - 200) < 10000;
      image.pixel(x, y)[0] = static_cast<std::uint8_t>(inside ? x / 3 : 250 - y / 10);
      image.pixel(x, y)[1] = static_cast<std::uint8_t>(inside ? y / 3 : 250 - y / 10);
      image.pixel(x, y)[2] = 200;
    }
  return image;
}

TEST(Image, KnowsItsPixels) {
  Image image(3, 2);
  image.pixel(2, 1)[2] = 9;
  EXPECT_EQ(image.rgb.back(), 9);
  EXPECT_EQ(image.at(2, 1), (std::array<int, 3>{0, 0, 9}));
  EXPECT_REX_ERROR(Image(0, 5), "image size: found 0 x 5, wanted at least 1 x 1 pixels");
}

TEST(Png, ComesBackAsWritten) {
  const fs::path folder = freshFolder("png");
  for (const auto& [width, height] : {std::pair{1, 1}, {33, 7}, {200, 150}}) {
    const Image image = noise(width, height);
    writePng(image, folder / "noise.png");
    EXPECT_EQ(readPng(folder / "noise.png"), image);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}), 1);
}

TEST(Png, CompressesPicturesAndDoesNotBlowUpNoise) {
  const fs::path folder = freshFolder("png-size");
  writePng(scenery(640, 480), folder / "scenery.png");
  writePng(noise(640, 480), folder / "noise.png");
  EXPECT_LT(fs::file_size(folder / "scenery.png"), 640 * 480 * 3 / 20);
  EXPECT_LT(fs::file_size(folder / "noise.png"), 640 * 480 * 3 * 1.01);
}

TEST(Png, NamesThePathItCannotWriteAndLeavesNothing) {
  const fs::path folder = freshFolder("png-errors");
  const Image image = noise(4, 4);
  EXPECT_REX_ERROR(writePng(image, folder / "missing" / "a.png"), "missing/a.png': found No such file");
  fs::create_directories(folder / "taken.png" / "inside");
  EXPECT_REX_ERROR(writePng(image, folder / "taken.png"), "cannot write '");
  EXPECT_REX_ERROR(writePng(image, ""), "cannot write '': found ");
  EXPECT_REX_ERROR(writePng(image, folder / std::string(300, 'x')), "x': found File name too long");
  EXPECT_REX_ERROR(writePng(Image{}, folder / "empty.png"), "empty.png': found an image without pixels");
  EXPECT_REX_ERROR(encodePng(Image{}), "cannot make a PNG image: found an image without pixels");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}), 1);
}

TEST(Png, RejectsWhatLibpngCannotHold) {
  const fs::path folder = freshFolder("png-wide");
  Image image;
  image.width = 2'000'000;
  image.height = 1;
  image.rgb.resize(6'000'000);
  EXPECT_REX_ERROR(writePng(image, folder / "wide.png"), "wide.png': found Invalid IHDR data");
}

TEST(Png, NamesThePathItCannotRead) {
  const fs::path folder = freshFolder("png-read");
  EXPECT_REX_ERROR(readPng(folder / "none.png"), "none.png': found No such file or directory, wanted a PNG");
  std::ofstream(folder / "text.png") << "this is not a picture";
  EXPECT_REX_ERROR(readPng(folder / "text.png"), "text.png': found");
  writePng(noise(50, 50), folder / "half.png");
  fs::resize_file(folder / "half.png", fs::file_size(folder / "half.png") / 2);
  EXPECT_REX_ERROR(readPng(folder / "half.png"), "half.png': found");
}

void appendBigEndian(std::string& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
}

TEST(Png, RefusesPicturesTooLargeToHold) {
  const fs::path folder = freshFolder("png-huge");
  writePng(noise(1, 1), folder / "huge.png");
  std::string bytes = fileText(folder / "huge.png");
  std::string header = "IHDR";
  appendBigEndian(header, 900'000);
  appendBigEndian(header, 800'000);
  header += bytes.substr(24, 5);
  const auto sum =
      ::crc32(0, reinterpret_cast<const unsigned char*>(header.data()), static_cast<unsigned>(header.size()));
  appendBigEndian(header, static_cast<std::uint32_t>(sum));
  std::ofstream(folder / "huge.png", std::ios::binary) << bytes.replace(12, 21, header);
  EXPECT_REX_ERROR(readPng(folder / "huge.png"),
                   "huge.png': found 900000 x 800000 pixels, wanted at most 100 million");
}

}  // namespace rex::image_test

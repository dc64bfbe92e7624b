#include "render/contact_sheet.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "render/color.h"
#include "render/image.h"
#include "render/text.h"

namespace rex {
namespace {

constexpr int kGap = 10;   // pixels around each picture
constexpr int kAbove = 5;  // pixels between a picture and its caption
const Color kInk{0.1f, 0.1f, 0.12f};

void requireAtLeast(int least, int value, const char* what) {
  if (value >= least) return;
  throw Error({.what = fmt::format("contact sheet: {}", what),
               .found = fmt::format("{}", value),
               .wanted = fmt::format("at least {}", least)});
}

Image white(int width, int height) {
  Image image(width, height);
  std::fill(image.rgb.begin(), image.rgb.end(), std::uint8_t{255});
  return image;
}

void paste(Image& onto, const Image& image, int left, int top) {
  for (int y = 0; y < image.height; ++y)
    std::copy_n(image.pixel(0, y), 3 * image.width, onto.pixel(left, top + y));
}

// A thin grey line around the pixels [left, right) x [top, bottom): pictures are nearly white at the edge.
void outline(Image& image, int left, int top, int right, int bottom) {
  constexpr std::uint8_t kGrey = 200;
  for (int x = left - 1; x <= right; ++x) {
    std::fill_n(image.pixel(x, top - 1), 3, kGrey);
    std::fill_n(image.pixel(x, bottom), 3, kGrey);
  }
  for (int y = top - 1; y <= bottom; ++y) {
    std::fill_n(image.pixel(left - 1, y), 3, kGrey);
    std::fill_n(image.pixel(right, y), 3, kGrey);
  }
}

}  // namespace

void requireValid(const ContactSheetOptions& options) {
  requireAtLeast(2, options.pictures, "pictures");
  requireAtLeast(1, options.columns, "columns");
  requireAtLeast(16, options.pictureWidth, "width of a picture");
}

std::vector<std::size_t> keyFrames(std::size_t count, int most) {
  std::vector<std::size_t> chosen;
  const std::size_t pictures = std::min(count, static_cast<std::size_t>(most));
  for (std::size_t i = 0; i < pictures; ++i) {
    const std::size_t gaps = std::max<std::size_t>(pictures - 1, 1);
    chosen.push_back((i * (count - 1) + gaps / 2) / gaps);
  }
  return chosen;
}

Image contactSheet(const std::vector<KeyFrame>& frames, const ContactSheetOptions& options) {
  requireValid(options);
  if (frames.empty()) throw Error({.what = "a contact sheet without pictures"});
  std::vector<Image> pictures;
  int width = 0, height = 0;
  for (const KeyFrame& frame : frames) {
    pictures.push_back(shrunk(frame.image, options.pictureWidth));
    width = std::max(width, pictures.back().width);
    height = std::max(height, pictures.back().height);
  }
  const int cellWidth = width + kGap, cellHeight = height + kAbove + textSize("0").height + kGap;
  const int count = static_cast<int>(frames.size());
  const int columns = std::min(options.columns, count), rows = (count + columns - 1) / columns;
  Image sheet = white(columns * cellWidth + kGap, rows * cellHeight + kGap);
  for (int i = 0; i < count; ++i) {
    const Image& picture = pictures[static_cast<std::size_t>(i)];
    // Drawn on a cell of its own, so that a long caption is cut off at its edge.
    Image cell = white(cellWidth, cellHeight);
    paste(cell, picture, 1, 1);
    outline(cell, 1, 1, 1 + picture.width, 1 + picture.height);
    drawText(cell, frames[static_cast<std::size_t>(i)].caption, 1, 1 + height + kAbove, kInk);
    paste(sheet, cell, kGap - 1 + i % columns * cellWidth, kGap - 1 + i / columns * cellHeight);
  }
  return sheet;
}

}  // namespace rex

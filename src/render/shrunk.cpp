#include "render/shrunk.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rex {
namespace {

// One old cell covered by a new one, and its share of the new one.
struct Part {
  int cell;
  double share;
};

// For each of `to` new cells, the old ones of `from` it covers.
std::vector<std::vector<Part>> coverage(int from, int to) {
  std::vector<std::vector<Part>> all(static_cast<std::size_t>(to));
  const double step = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    const double begin = i * step, end = std::min((i + 1) * step, static_cast<double>(from));
    for (int cell = static_cast<int>(begin); cell < end; ++cell)
      all[static_cast<std::size_t>(i)].push_back(
          {cell, (std::min<double>(end, cell + 1) - std::max<double>(begin, cell)) / step});
  }
  return all;
}

}  // namespace

Image shrunk(const Image& image, int width) {
  if (width >= image.width) return image;
  const double height = static_cast<double>(image.height) * width / image.width;
  Image small(width, std::max(1, static_cast<int>(std::lround(height))));
  const auto columns = coverage(image.width, small.width), rows = coverage(image.height, small.height);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      double sum[3] = {};
      for (const Part& row : rows[static_cast<std::size_t>(y)]) {
        for (const Part& column : columns[static_cast<std::size_t>(x)]) {
          const std::uint8_t* old = image.pixel(column.cell, row.cell);
          for (int c = 0; c < 3; ++c) sum[c] += row.share * column.share * old[c];
        }
      }
      for (int c = 0; c < 3; ++c) small.pixel(x, y)[c] = static_cast<std::uint8_t>(sum[c] + 0.5);
    }
  }
  return small;
}

}  // namespace rex

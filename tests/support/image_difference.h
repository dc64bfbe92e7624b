#pragma once

#include <algorithm>
#include <cstdlib>

#include "render/image.h"

namespace rex {

/// How far two images of one size are apart, in steps of 1/255.
struct ImageDifference {
  double mean = 0;        ///< over all channels of all pixels
  double largeShare = 0;  ///< share of pixels with a channel that differs by more than `large`
  Image picture;          ///< the difference, times 8
};

inline ImageDifference imageDifference(const Image& a, const Image& b, int large) {
  ImageDifference result{.picture = Image(a.width, a.height)};
  int largePixels = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      int most = 0;
      for (int c = 0; c < 3; ++c) {
        const int apart = std::abs(a.pixel(x, y)[c] - b.pixel(x, y)[c]);
        most = std::max(most, apart);
        result.mean += apart;
        result.picture.pixel(x, y)[c] = static_cast<std::uint8_t>(std::min(255, 8 * apart));
      }
      largePixels += most > large ? 1 : 0;
    }
  }
  const double pixels = static_cast<double>(a.width) * a.height;
  result.mean /= 3 * pixels;
  result.largeShare = largePixels / pixels;
  return result;
}

}  // namespace rex

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "render/image.h"

namespace rex {

/// A picture in a contact sheet and the text below it.
struct KeyFrame {
  Image image{};
  std::string caption{};  ///< one line
};

struct ContactSheetOptions {
  int pictures = 6;        ///< maximum number, at least 2
  int columns = 3;         ///< pictures side by side, at least 1
  int pictureWidth = 480;  ///< pixels; wider pictures are shrunk
};

/// Throws Error for an option out of range.
void requireValid(const ContactSheetOptions& options);

/// The frames, of `count`, that represent a film: at most `most` (at least 2), evenly spaced, including the
/// first and last.
[[nodiscard]] std::vector<std::size_t> keyFrames(std::size_t count, int most);

/// The pictures in rows on white, in cells of the size that the largest one needs. Throws Error if there is
/// no picture, and for an option out of range.
[[nodiscard]] Image contactSheet(const std::vector<KeyFrame>& frames,
                                 const ContactSheetOptions& options = {});

}  // namespace rex

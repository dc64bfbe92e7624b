#pragma once

#include <filesystem>
#include <string>

#include "render/image.h"

namespace rex {

/// Writes an 8-bit RGB PNG. The file appears whole or not at all. Throws Error naming the path if that
/// fails, and for an image without pixels.
void writePng(const Image& image, const std::filesystem::path& path);

/// The bytes that writePng() writes. Throws Error for an image without pixels.
[[nodiscard]] std::string encodePng(const Image& image);

/// Reads any PNG of up to 100 million pixels as 8-bit RGB; transparent parts become black. Throws Error
/// naming the path and the cause.
[[nodiscard]] Image readPng(const std::filesystem::path& path);

}  // namespace rex

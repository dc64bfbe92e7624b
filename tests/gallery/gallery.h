#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rex::gallery {

/// Draws all pictures and figures into `folder` as NAME.png; their names, in the order of the page.
std::vector<std::string> drawAll(const std::filesystem::path& folder);

/// The page that shows them, for a file beside the folder `gallery`.
[[nodiscard]] std::string page();

}  // namespace rex::gallery

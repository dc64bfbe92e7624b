#pragma once

#include <filesystem>

namespace rex {

/// The folder with rex's programs and, in lib/, its libraries: build/PRESET, or PREFIX/lib/rex where it is
/// installed. It is found from where this library was loaded, so an installed tree may be moved.
[[nodiscard]] const std::filesystem::path& ownFolder();

/// The folder of what is not compiled (data/, exercises/, share/), to which `home` in ownFolder() leads: the
/// root of the project, or PREFIX/share/rex. Whoever opens a file in it says if it is missing.
[[nodiscard]] const std::filesystem::path& homeFolder();

/// Whether rex was installed: ownFolder() is no build folder.
[[nodiscard]] bool isInstalled();

/// Whether this path, absolute and without links, is or lies in one of these two folders.
[[nodiscard]] bool isOwnFile(const std::filesystem::path& path);

}  // namespace rex

#pragma once

#include <filesystem>
#include <string>

namespace rex::cli {

/// Makes the folder for NAME.csv, NAME.mp4 and NAME_sheet.png, and removes the film and contact sheet of an
/// earlier run. Throws UsageError naming -o if it cannot be made or written to.
void makeFilmFolder(const std::filesystem::path& folder, const std::string& name);

}  // namespace rex::cli

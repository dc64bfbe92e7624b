#include "cli/methods/film_folder.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "base/error.h"
#include "cli/terminal.h"

namespace rex::cli {

void makeFilmFolder(const std::filesystem::path& folder, const std::string& name) {
  const auto refuse = [&](const std::string& found, const std::string& wanted) {
    throw UsageError({.what = "-o " + harmless(folder.string()), .found = found, .wanted = wanted});
  };
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem || !std::filesystem::is_directory(folder))
    refuse(problem ? problem.message() : "a file", "a folder");
  if (!std::ofstream(folder / (name + ".csv"), std::ios::app))
    refuse(std::strerror(errno), "a folder to write to");
  for (const char* ending : {".mp4", "_sheet.png"})
    std::filesystem::remove(folder / (name + ending), problem);
}

}  // namespace rex::cli

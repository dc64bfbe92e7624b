#include "cli/out_folder.h"

#include <system_error>

#include "base/error.h"

namespace rex::cli {

void makeOutFolder(const std::filesystem::path& folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem)
    throw Error({.what = "cannot make the folder for results",
                 .where = {folder.string()},
                 .found = problem.message()});
}

}  // namespace rex::cli

#include "sandbox/hidden_folders.h"

#include <algorithm>
#include <system_error>

#include "base/is_below.h"

namespace rex::sandbox {
namespace {

namespace fs = std::filesystem;

void addAllBut(const fs::path& place, const std::vector<fs::path>& hidden, std::vector<fs::path>& found) {
  std::error_code failed;
  const fs::path real = fs::canonical(place, failed);
  if (failed) return;
  const auto isHidden = [&](const fs::path& one) { return isBelow(one, real); };
  const auto hides = [&](const fs::path& one) { return isBelow(real, one); };
  if (std::any_of(hidden.begin(), hidden.end(), isHidden)) return;
  if (std::none_of(hidden.begin(), hidden.end(), hides)) {
    found.push_back(place);
  } else if (real == place) {
    for (const auto& entry : fs::directory_iterator(place, failed)) addAllBut(entry.path(), hidden, found);
  }
}

}  // namespace

std::vector<fs::path> hiddenFolders(const fs::path& launcher) {
  std::vector<fs::path> hidden;
  const fs::path own = launcher.parent_path();
  for (const fs::path& folder : {own, own / "home"}) {
    std::error_code missing;
    const fs::path real = fs::canonical(folder, missing);
    if (!missing && isBelow("/usr", real)) hidden.push_back(real);
  }
  return hidden;
}

std::vector<fs::path> allBut(const fs::path& folder, const std::vector<fs::path>& hidden) {
  std::vector<fs::path> found;
  addAllBut(folder, hidden, found);
  return found;
}

}  // namespace rex::sandbox

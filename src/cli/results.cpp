#include "cli/project.h"
#include "cli/results_internal.h"
#include "cli/terminal.h"

namespace rex::cli {

std::filesystem::path Results::file(const std::filesystem::path& path) {
  json["files"].push_back(shown(path));
  return path;
}

void Results::print(bool asJson) const {
  if (asJson) return say(dump(json));
  for (const std::string& one : lines) say(one);
  if (json.contains("files"))
    for (const Json& path : json["files"]) say(shown(path.get<std::string>()));
}

}  // namespace rex::cli

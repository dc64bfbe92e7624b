#include <algorithm>

#include "cli/project.h"
#include "cli/results_internal.h"
#include "cli/terminal.h"

namespace rex::cli {

void Table::add(std::string name, const Eigen::Ref<const Eigen::VectorXd>& values,
                std::string (*format)(double)) {
  std::vector<std::string> row{std::move(name)};
  for (const double value : values) row.push_back(format(value));
  rows_.push_back(std::move(row));
}

std::string Table::text() const {
  std::vector<std::size_t> widths = {first_};
  for (const auto& row : rows_) {
    widths.resize(std::max(widths.size(), row.size()), numbers_);
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i)
      text += i > 0 && numbers_ > 0 ? fmt::format(" {:>{}}", row[i], widths[i])
                                    : fmt::format("{:{}}{}", row[i], widths[i], numbers_ > 0 ? "" : "  ");
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  if (!text.empty()) text.pop_back();
  return text;
}

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

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <span>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "base/join.h"
#include "base/text_file.h"
#include "cli/robot/matrix_file_internal.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

// "A, B and C".
std::string listedNames(const std::vector<std::string>& names) {
  return fmt::format("{} and {}", join(std::span(names).first(names.size() - 1), ", "), names.back());
}

Json parsedObject(const std::string& text, const std::string& file, const std::string& wanted) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    // The parser counts bytes from 1.
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(
                                        text.size(), error.byte > 0 ? error.byte - 1 : std::size_t{0}));
    const auto line = std::find(std::make_reverse_iterator(end), text.rend(), '\n').base();
    throw Error({.what = "not valid JSON",
                 .where = {file, static_cast<int>(1 + std::count(text.begin(), end, '\n')),
                           static_cast<int>(1 + (end - line))},
                 .wanted = wanted});
  } catch (const Json::out_of_range&) {
    throw Error({.what = "JSON",
                 .where = {.file = file},
                 .found = "a number that is too large",
                 .wanted = "numbers below 1.8e308"});
  }
}

}  // namespace

MatrixFile::MatrixFile(const std::filesystem::path& path, const std::filesystem::path& given,
                       const std::vector<std::string>& known)
    : file_(harmless(given.string())) {
  const std::string wanted = "an object with the fields " + listedNames(known);
  object_ = parsedObject(readTextFile(path), file_, wanted);
  if (!object_.is_object())
    throw wrong("matrices", fmt::format("a JSON value of type {}", object_.type_name()), wanted);
  std::vector<std::string> unused;
  for (const auto& field : object_.items())
    if (std::find(known.begin(), known.end(), field.key()) == known.end())
      unused.push_back(harmless(field.key()));
  if (!unused.empty()) note(wrap(fmt::format("rex: {}: not used: {}", file_, join(unused, ", ")), 2, 0));
}

Error MatrixFile::wrong(const std::string& what, const std::string& found, const std::string& wanted) const {
  return Error({.what = what, .where = {.file = file_}, .found = found, .wanted = wanted});
}

double MatrixFile::numberOf(const Json& json, const std::string& what) const {
  if (json.is_number()) return json.get<double>();
  throw wrong(what, json.is_null() ? "null" : fmt::format("a value of type {}", json.type_name()),
              "a number");
}

double MatrixFile::number(const std::string& name) const { return numberOf(object_[name], name); }

Eigen::MatrixXd MatrixFile::matrix(const std::string& name) const {
  if (!object_.contains(name)) {
    // The names have one letter, so the only likely slip is the wrong case.
    const std::string small(1, static_cast<char>(std::tolower(name[0])));
    throw Error({.what = "matrix " + name,
                 .where = {.file = file_},
                 .found = "no field with this name",
                 .wanted = "a list of rows",
                 .nearest = object_.contains(small) ? std::vector{small} : std::vector<std::string>{}});
  }
  const Json& rows = object_[name];
  if (rows.is_object() && rows.contains("re") && rows.contains("im"))
    throw wrong("matrix " + name, "complex entries", "real ones");
  if (!rows.is_array() || rows.empty() || !rows[0].is_array())
    throw wrong("matrix " + name, "no list of rows", "rows of numbers, such as [[1, 0], [0, 1]]");
  Eigen::MatrixXd M(rows.size(), rows[0].size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string row = fmt::format("matrix {}, row {}", name, i + 1);
    if (!rows[i].is_array() || rows[i].size() != rows[0].size())
      throw wrong(row, rows[i].is_array() ? fmt::format("{} numbers", rows[i].size()) : "no list of numbers",
                  fmt::format("{} numbers, as in row 1", rows[0].size()));
    for (std::size_t k = 0; k < rows[i].size(); ++k)
      M(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          numberOf(rows[i][k], fmt::format("{}, column {}", row, k + 1));
  }
  return M;
}

std::filesystem::path inProject(const Project& project, const std::filesystem::path& file) {
  const bool isExample = !std::filesystem::exists(file) && std::filesystem::exists(project.files() / file);
  return isExample ? project.files() / file : file;
}

std::string matrixText(const char* name, const Eigen::MatrixXd& M) {
  std::ostringstream text;
  text << M.format(Eigen::IOFormat(8, 0, "  ", "\n", "  "));
  return fmt::format("{} =\n{}", name, text.str());
}

Json jsonOfComplex(const Eigen::VectorXcd& values) {
  Json list = Json::array();
  for (const std::complex<double> value : values) list.push_back(Json::array({value.real(), value.imag()}));
  return list;
}

void sayComplex(const Eigen::VectorXcd& values) {
  for (const std::complex<double> value : values)
    say(fmt::format("  {:.8g} {:+.8g}i", value.real(), value.imag()));
}

}  // namespace rex::cli

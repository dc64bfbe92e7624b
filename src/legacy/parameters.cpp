#include "legacy/parameters.h"

#include <optional>
#include <vector>

#include "base/error.h"
#include "base/text.h"

namespace MT {
namespace {

std::vector<std::string> arguments;

std::optional<std::string> textOf(const std::string& name) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] != "-" + name) continue;
    if (i + 1 == arguments.size())
      throw rex::Error({.what = "parameter -" + name, .found = "nothing after it", .wanted = "its value"});
    return arguments[i + 1];
  }
  return std::nullopt;
}

template <class Number>
Number numberOf(const char* name, const Number& usual, const char* wanted) {
  const std::optional<std::string> text = textOf(name);
  if (!text) return usual;
  if (const std::optional<Number> number = rex::parseNumber<Number>(*text)) return *number;
  throw rex::Error({.what = std::string("parameter -") + name, .found = "'" + *text + "'", .wanted = wanted});
}

}  // namespace

void initCmdLine(int argc, char** argv) { arguments.assign(argv + 1, argv + argc); }

template <>
int getParameter(const char* name, const int& usual) {
  return numberOf(name, usual, "a whole number");
}

template <>
double getParameter(const char* name, const double& usual) {
  return numberOf(name, usual, "a number");
}

template <>
bool getParameter(const char* name, const bool& usual) {
  return numberOf(name, usual ? 1 : 0, "0 or 1") != 0;
}

template <>
std::string getParameter(const char* name, const std::string& usual) {
  return textOf(name).value_or(usual);
}

}  // namespace MT

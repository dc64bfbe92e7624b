#include <fmt/format.h>

#include "base/error.h"
#include "geometry/rotation.h"
#include "scene/urdf_markup_internal.h"
#include "scene/xml_element_internal.h"

namespace rex::urdf {
namespace {

// XML lacks some characters, and bytes that are not UTF-8.
void requireXml(const std::string& text, const std::string& markup) {
  try {
    static_cast<void>(xml::parse(fmt::format("<a b=\"{}\"/>", markup), "name"));
  } catch (const Error&) {
    throw Error({.what = "a name in URDF",
                 .found = xml::quoted(text),
                 .wanted = "characters that XML allows, in UTF-8"});
  }
}

std::string escaped(const std::string& text) {
  std::string result;
  bool isPlain = true;
  for (const char c : text) {
    const bool isControl = static_cast<unsigned char>(c) < 0x20;
    isPlain = isPlain && !isControl && static_cast<unsigned char>(c) < 0x7f;
    if (isControl || c == '&' || c == '<' || c == '>' || c == '"') {
      result += fmt::format("&#{};", static_cast<int>(c));
    } else {
      result += c;
    }
  }
  if (!isPlain) requireXml(text, result);
  return result;
}

}  // namespace

std::string numeral(double number) {
  return fmt::format("{}", number + 0.0);  // no -0
}

std::string numeral(const Eigen::VectorXd& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : " ") + numeral(number);
  return text;
}

void Markup::close(const char* tag) {
  --depth_;
  text += fmt::format("{:{}}</{}>\n", "", 2 * depth_, tag);
}

void Markup::origin(const Pose& X) {
  if (X.R.isIdentity(0) && X.p.isZero(0)) return;
  empty("origin", {{"xyz", numeral(X.p)}, {"rpy", numeral(rollPitchYawFromRotation(X.R))}});
}

void Markup::line(const char* tag, const Attributes& attributes, const char* end) {
  text += fmt::format("{:{}}<{}", "", 2 * depth_, tag);
  for (const auto& [name, value] : attributes)
    if (!value.empty()) text += fmt::format(" {}=\"{}\"", name, escaped(value));
  text += end;
  text += '\n';
}

}  // namespace rex::urdf

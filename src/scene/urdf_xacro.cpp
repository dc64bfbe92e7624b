#include <optional>

#include <fmt/format.h>

#include "base/lower_case.h"
#include "scene/urdf_parts_internal.h"

namespace rex::urdf {
namespace {

// The part of an element that xacro must process first.
struct Xacro {
  SourceLocation where;
  std::string found;
};

std::optional<Xacro> xacroIn(const xml::Document& document, const xml::Element& element) {
  if (element.name.starts_with("xacro:"))
    return Xacro{document.where(element.at), fmt::format("<{}>", element.name)};
  for (const xml::Attribute& attribute : element.attributes) {
    if (attribute.name.starts_with("xacro:"))
      return Xacro{document.where(attribute.at), xml::quoted(attribute.name)};
    const std::size_t at = std::min(attribute.value.find("${"), attribute.value.find("$("));
    if (at != std::string::npos)
      return Xacro{document.where(attribute, at), xml::quoted(std::string_view(attribute.value).substr(at))};
  }
  for (const xml::Element& child : element.children)
    if (std::optional<Xacro> found = xacroIn(document, child)) return found;
  return {};
}

}  // namespace

void refuseXacro(const xml::Document& document, const std::string& format) {
  const std::optional<Xacro> xacro = xacroIn(document, document.root);
  if (!xacro) return;
  throw Error({.what = fmt::format("this is xacro, not yet {}", format),
               .where = xacro->where,
               .found = xacro->found,
               .wanted = fmt::format("plain {}: run 'xacro FILE > robot.{}' and read that", format,
                                     lowerCase(format))});
}

}  // namespace rex::urdf

#include <fmt/format.h>

#include "scene/urdf_parts_internal.h"

namespace rex::urdf {
namespace {

[[noreturn]] void fail(const SourceLocation& where, const std::string& found) {
  throw Error({.what = "this is xacro, not yet URDF",
               .where = where,
               .found = found,
               .wanted = "plain URDF: run 'xacro FILE > robot.urdf' and read that"});
}

void refuseIn(const xml::Document& document, const xml::Element& element) {
  if (element.name.starts_with("xacro:")) fail(document.where(element.at), fmt::format("<{}>", element.name));
  for (const xml::Attribute& attribute : element.attributes) {
    if (attribute.name.starts_with("xacro:")) fail(document.where(attribute.at), xml::quoted(attribute.name));
    const std::size_t at = std::min(attribute.value.find("${"), attribute.value.find("$("));
    if (at != std::string::npos)
      fail(document.where(attribute, at), xml::quoted(std::string_view(attribute.value).substr(at)));
  }
  for (const xml::Element& child : element.children) refuseIn(document, child);
}

}  // namespace

void refuseXacro(const xml::Document& document) { refuseIn(document, document.root); }

}  // namespace rex::urdf

#pragma once

#include <string_view>

namespace rex::internal {

/// The page of a report, which the build puts into the library: a template with {{names}} of what is to be
/// filled in, its style and its scripts, and their SHA-256 in hexadecimal digits.
struct ReportTemplate {
  std::string_view html, style, styleHash, viewer, viewerHash, threeJs, threeJsHash;
};

[[nodiscard]] ReportTemplate reportTemplate();

}  // namespace rex::internal

#pragma once

#include <string_view>

namespace rex::internal {

/// The page of a report, which the build puts into the library: a template with {{names}} of what is to be
/// filled in, its style and its scripts (three.js is `library`), and their SHA-256 in hexadecimal digits.
struct ReportPage {
  std::string_view page, style, styleHash, viewer, viewerHash, library, libraryHash;
};

[[nodiscard]] ReportPage reportTemplate();

}  // namespace rex::internal

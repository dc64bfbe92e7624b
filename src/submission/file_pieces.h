#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// A declaration, a definition or a line of the preprocessor of a C++ file: at file scope, or in a namespace
/// without a name, whose first line and last brace are pieces as well.
struct FilePiece {
  std::size_t start = 0, end = 0;  ///< its characters; comments before it do not count
  /// The name of a plain function; empty for anything else, and where that is not sure, as for a template.
  std::string function{};
  std::size_t nameStart = 0, bodyStart = 0;  ///< of a function: where its name and its '{' are
  bool isInternal = false;                   ///< in a namespace without a name: the linker does not see it
};

/// All pieces of a file, in order. Text that is not C++ has pieces as well, of no meaning.
[[nodiscard]] std::vector<FilePiece> filePieces(std::string_view source);

}  // namespace rex::grading

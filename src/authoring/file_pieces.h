#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// A declaration, a definition or a line of the preprocessor between all braces of a C++ file.
struct FilePiece {
  std::size_t start = 0, end = 0;  ///< its characters; comments before it do not count
  /// The name, and where that starts, if it is a function that the linker can put another in place of; empty
  /// also where that is not sure, as for a template or what has no name outside of the file.
  std::string function{};
  std::size_t nameStart = 0;
};

/// All pieces of a file, in order. Text that is no C++ has pieces as well, of no meaning.
[[nodiscard]] std::vector<FilePiece> filePieces(std::string_view source);

}  // namespace rex::grading

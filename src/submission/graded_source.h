#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "submission/cpp_text.h"

namespace rex::submission {

/// A declaration, a definition or a preprocessor line of a C++ file, at file scope or in an unnamed
/// namespace. The first line and the last brace of such a namespace are pieces, too.
struct CppPiece {
  std::size_t start = 0, end = 0;   ///< its characters, without comments before it
  std::size_t first = 0, last = 0;  ///< its first token, and the one after it
  /// The name of a plain function; empty for anything else, and if that is uncertain, as for a template.
  std::string_view function{};               ///< part of the source
  std::size_t nameStart = 0, bodyStart = 0;  ///< for a function: where its name and its '{' are
  bool isInternal = false;                   ///< in an unnamed namespace: invisible to the linker
  bool isDirective = false;                  ///< for the preprocessor
};

/// All pieces of a file, in order. Text that is not C++ gives meaningless pieces.
[[nodiscard]] std::vector<CppPiece> cppPieces(const CppText& text);

/// A student's file in which the compiler reads everything, and warns about it, but makes code only of
/// `functions` and what they need. main() and what only main() needs, which takes as long, gets further
/// words, between pieces and before the last brace, so that the rest keeps its lines, columns and behaviour;
/// if that is short, nothing. Empty if none of the functions exists, or if a function other than main() of
/// which no code is made names one of `watched`. The result need not compile.
[[nodiscard]] std::string gradedSource(std::string_view source, const std::vector<std::string>& functions,
                                       const std::vector<std::string>& watched);

}  // namespace rex::submission

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

// XML as a tree of elements, before anything is known about robots.
namespace rex::xml {

/// name="value" with all references resolved. Offsets count bytes from the start of the text.
struct Attribute {
  std::string name, value;
  std::uint32_t at = 0;       ///< of the first letter of the name
  std::uint32_t valueAt = 0;  ///< of the first character between the quotes
};

struct Element {
  std::string name;
  std::vector<Attribute> attributes;
  std::vector<Element> children;
  std::uint32_t at = 0;                   ///< of its '<'
  std::optional<std::uint32_t> textAt{};  ///< of its first text that is not blank
};

/// A parsed file. Refers to the text, which must outlive it.
class Document {
 public:
  Document(std::string_view text, std::string file);

  Element root;
  std::uint32_t declarationAt = 0;  ///< of '<?xml', if blanks before it were skipped

  SourceLocation where(std::uint32_t offset) const;
  /// Where the `index`-th character of the value stands, seen through references such as &amp;.
  SourceLocation where(const Attribute& attribute, std::size_t index) const;

 private:
  std::string_view text_;
  std::string file_;
  std::vector<std::uint32_t> lines_;  // where they begin
};

/// Parses a whole file. Throws Error with file, line and column: not well-formed; a document type (and so
/// entities of one's own); an encoding other than UTF-8, US-ASCII and ISO-8859-1; more than 8 MiB, elements
/// nested deeper than 100, 200 000 elements, 64 attributes of one element, or 256 bytes in a name. With
/// `skipBlanks`, blanks and marks of UTF-8 may stand before the declaration, where XML allows none. `root`
/// is the tag that messages ask for in a file that is not XML at all.
[[nodiscard]] Document parse(std::string_view text, const std::string& fileName, bool skipBlanks = false,
                             const std::string& root = "<robot ...>");

/// `text` in quotes as a message shows it: at most 60 bytes, control characters as \xNN.
[[nodiscard]] std::string quoted(std::string_view text);

}  // namespace rex::xml

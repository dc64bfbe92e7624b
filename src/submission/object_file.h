#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// A named symbol of an object file. Those that stand for sections and for the source are left out.
struct ObjectSymbol {
  std::string name;
  bool isDefined = false;  ///< here, not in another file
  bool isGlobal = false;   ///< seen by other files, and the only one of its name
  bool isWeak = false;     ///< seen by other files, and gives way to others of its name
  bool isShared = false;   ///< one of many equal copies: its section is in a group, as those of templates are
  bool isReferred = false;  ///< the linker writes its address somewhere: some relocation names it
};

/// A section that the linker will read.
struct ObjectSection {
  std::string name;
  unsigned type = 0;  ///< SHT_ of elf.h
};

/// What an object file of this machine's kind holds, section 0 left out.
struct ObjectFile {
  std::vector<ObjectSection> sections;
  std::vector<ObjectSymbol> symbols;
};

/// Reads a relocatable ELF file of 64 bits in this machine's byte order, by the System V ABI (gABI, chapter
/// 4). Trusts no size, offset or index in it. Throws Error that names `file` where one leads out of the
/// file, where there is no table of symbols or a second one, and for relocations of other symbols.
[[nodiscard]] ObjectFile readObjectFile(std::string_view bytes, const std::string& file);

}  // namespace rex::grading

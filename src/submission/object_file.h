#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// A named symbol of an object file. Symbols for sections and for the source file are left out.
struct ObjectSymbol {
  std::string name;
  bool isDefined = false;   ///< in this file
  bool isGlobal = false;    ///< visible to other files, and unique
  bool isWeak = false;      ///< visible to other files, and replaced by a global one of the same name
  bool isShared = false;    ///< one of many equal copies: its section is in a group, as for templates
  bool isReferred = false;  ///< some relocation names it: the linker writes its address somewhere
};

/// A section that the linker will read.
struct ObjectSection {
  std::string name;
  unsigned type = 0;             ///< SHT_... of elf.h
  std::size_t ofEachThread = 0;  ///< bytes of variables that each thread has for itself
};

/// The contents of an object file for this machine, without section 0.
struct ObjectFile {
  std::vector<ObjectSection> sections;
  std::vector<ObjectSymbol> symbols;
};

/// Reads a relocatable 64-bit ELF file in this machine's byte order (System V gABI, chapter 4). Trusts no
/// size, offset or index in it. Throws Error naming `file` if one of these leads out of the file, if there
/// is not exactly one symbol table, and for relocations that use other symbols.
[[nodiscard]] ObjectFile readObjectFile(std::string_view bytes, const std::string& file);

}  // namespace rex::grading

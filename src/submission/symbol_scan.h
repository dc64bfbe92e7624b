#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "submission/compiler_messages.h"
#include "submission/exercise_info.h"

namespace rex::submission {

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

/// Whether a symbol is the function `rex::f` with any arguments, a member of the class or namespace
/// `rex::f`, or generated for one of these (Itanium C++ ABI, section 5.1). `symbol` is mangled, as in the
/// object file.
[[nodiscard]] bool isSymbolFor(std::string_view symbol, std::string_view function);

/// "rex::f(int)" for the symbol of that function; the symbol itself if it is not mangled.
[[nodiscard]] std::string demangled(const std::string& symbol);

/// The forbidden functions that anything in an object file refers to, from any section. Functions and
/// tables for finding others at run time, such as dlsym(), are always forbidden.
[[nodiscard]] std::vector<ForbiddenFunction> forbiddenCalls(const ObjectFile& object,
                                                            const std::vector<ForbiddenFunction>& forbidden);

/// The library's functions and tables that an object file refers to without defining them and that are not
/// offered, with their C++ names: "rex::plot". `offers` comes from offeredSymbols().
[[nodiscard]] std::vector<std::string> callsNotOffered(const ObjectFile& object,
                                                       const std::vector<std::string>& offers);

/// Finds what no compiler writes into the object file of a C++ source: unprintable names, sections that
/// only the linker makes, sections with code for the linker to compile, and more than 64 MiB of variables of
/// each thread. Each is an error with the rule "forbidden-call". Call it before a linker reads the file.
[[nodiscard]] std::vector<grading::CompileDiagnostic> strangeParts(const ObjectFile& object,
                                                                   const std::string& mainFile);

/// Explains each of the forbiddenCalls() and, if a file of `offers` is given, callsNotOffered() of an
/// object file without main() (see withoutMain()) as an error with the rule "forbidden-call". It is at the
/// line of `source` that names the function, if there is exactly one outside main(). Throws Error like
/// readObjectFile().
[[nodiscard]] std::vector<grading::CompileDiagnostic> scanSymbols(
    const std::filesystem::path& object, std::string_view source, const std::string& mainFile,
    const std::vector<ForbiddenFunction>& forbidden, const std::filesystem::path& offers = {});

}  // namespace rex::submission

#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "submission/compiler_messages.h"
#include "submission/exercise_info.h"
#include "submission/object_file.h"

namespace rex::grading {

/// Whether a symbol is the function `rex::f` with any arguments, a member of the class or namespace
/// `rex::f`, or generated for one of these (Itanium C++ ABI, section 5.1). `symbol` is mangled, as in the
/// object file.
[[nodiscard]] bool isSymbolOf(std::string_view symbol, std::string_view function);

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
[[nodiscard]] std::vector<CompileDiagnostic> strangeParts(const ObjectFile& object,
                                                          const std::string& mainFile);

/// Explains each of the forbiddenCalls() and, if a file of `offers` is given, callsNotOffered() of an
/// object file without main() (see withoutMain()) as an error with the rule "forbidden-call". It is at the
/// line of `source` that names the function, if there is exactly one outside main(). Throws Error like
/// readObjectFile().
[[nodiscard]] std::vector<CompileDiagnostic> scanSymbols(const std::filesystem::path& object,
                                                         std::string_view source, const std::string& mainFile,
                                                         const std::vector<ForbiddenFunction>& forbidden,
                                                         const std::filesystem::path& offers = {});

}  // namespace rex::grading

#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "submission/compiler_messages.h"
#include "submission/exercise_info.h"
#include "submission/object_file.h"

namespace rex::grading {

/// Whether a symbol is the function `rex::f`, whatever its arguments, one of the class or the namespace
/// `rex::f`, or made for one of them (Itanium C++ ABI, section 5.1). `symbol` as it stands in the object
/// file.
[[nodiscard]] bool isSymbolOf(std::string_view symbol, std::string_view function);

/// The forbidden functions that anything in an object file refers to, by whatever section. Functions and
/// tables by which others are found while a program runs, such as dlsym(), are always among them.
[[nodiscard]] std::vector<ForbiddenFunction> forbiddenCalls(const ObjectFile& object,
                                                            const std::vector<ForbiddenFunction>& forbidden);

/// The functions and tables of the library that an object file refers to, does not have itself and is not
/// offered, by their names in C++: "rex::plot". `offers` as offeredSymbols() gives them.
[[nodiscard]] std::vector<std::string> callsNotOffered(const ObjectFile& object,
                                                       const std::vector<std::string>& offers);

/// What no compiler writes into an object file of a C++ source, each as an error of rule "forbidden-call":
/// names that do not print, sections that only the linker makes, and such as hold code for the linker to
/// compile. To be asked before a linker reads the file.
[[nodiscard]] std::vector<CompileDiagnostic> strangeParts(const ObjectFile& object,
                                                          const std::string& mainFile);

/// Explains each of the forbiddenCalls() and, where there is a file of `offers`, callsNotOffered() of an
/// object file that holds nothing of main() (see withoutMain()) as an error of rule "forbidden-call", at the
/// line of `source` that names the function if there is only one outside main(). Throws Error as
/// readObjectFile().
[[nodiscard]] std::vector<CompileDiagnostic> scanSymbols(const std::filesystem::path& object,
                                                         std::string_view source, const std::string& mainFile,
                                                         const std::vector<ForbiddenFunction>& forbidden,
                                                         const std::filesystem::path& offers = {});

}  // namespace rex::grading

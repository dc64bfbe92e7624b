"""What honest people hand in: a solution as others would have written or sent it."""

import io
import re
import tarfile
import zipfile

_HELPERS = """
#include <cassert>
#include <chrono>
#include <iostream>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <sstream>
#include <stdexcept>
#include <thread>
#define SQUARED(x) ((x) * (x))
struct Shape2 {
  virtual ~Shape2() = default;
  virtual double area() const = 0;
};
struct Square2 : Shape2 {
  double side = 2;
  double area() const override { return SQUARED(side); }
};
std::map<std::string, int> calledSoFar;
thread_local int depthOfCalls = 0;
double helperOfMine(const std::function<double(double)>& f) {
  std::unique_ptr<Shape2> shape = std::make_unique<Square2>();
  try {
    if (f(1) > 1e9) throw std::runtime_error("too large");
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\\n';
  }
  return shape->area();
}
"""


def _in_functions(source, functions, statement):
    """The statement at the beginning of each function's body."""
    for name in functions:
        source, count = re.subn(rf"^((?![ \t]|#|//|return|using).*\b{name}\([^;{{]*\)[^;{{]*\{{)\n", rf"\1\n{statement}\n", source,
                                flags=re.MULTILINE)
        if count == 0:
            raise ValueError(f"no function {name}")
    return source


def _after_includes(source, text):
    end = max(found.end() for found in re.finditer(r"^#include .*\n", source, flags=re.MULTILINE))
    return source[:end] + text + source[end:]


def right_variants(source, functions):
    """Name to bytes of files that are worth as much as the source, in which the functions are graded."""
    with_helpers = _after_includes(source, _HELPERS)
    prints = "  { static int calls = 0; if (++calls <= 3) std::printf(\"called\\\\n\"); }"
    asks = "  assert(helperOfMine([](double x) { return SQUARED(x); }) > 0); ++calledSoFar[\"x\"];"
    stream = "  { static bool told = false; if (!told) std::cerr << \"first call\" << std::endl; told = true; }"
    start = re.search(r"^int main\(", source, flags=re.MULTILINE).start()
    texts = {
        "reference": source,
        "no_main": source[:start] + "int main() {}\n",
        "tabs": re.sub(r"^( +)", lambda found: "\t" * (len(found[1]) // 2), source, flags=re.MULTILINE),
        "umlauts": source.replace("\n\n", "\n\n// Grüße aus Zürich: α, β und x² – “fertig” ✓\n\n", 3),
        "prints": _in_functions(_after_includes(source, "#include <cstdio>\n"), functions, prints),
        "helpers": _in_functions(with_helpers, functions, asks),
        "streams": _in_functions(with_helpers, functions, stream),
        "blocks": _in_functions(source, functions, "  {\n  }\n  ;"),
        "no_newline": source.rstrip("\n"),
    }
    files = {name: text.encode() for name, text in texts.items()}
    files["crlf"] = source.replace("\n", "\r\n").encode()
    files["bom"] = b"\xef\xbb\xbf" + source.encode()
    return files


def _zip(entries, how=zipfile.ZIP_DEFLATED):
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", how) as archive:
        for name, content in entries:
            archive.writestr(name, content)
    return made.getvalue()


def _tar(entries, mode):
    made = io.BytesIO()
    with tarfile.open(fileobj=made, mode=mode) as archive:
        for name, content in entries:
            entry = tarfile.TarInfo(name)
            entry.size = len(content)
            archive.addfile(entry, io.BytesIO(content))
    return made.getvalue()


def packed(content, kind, student, exercise):
    """(path, bytes) of what a student hands in: the file itself or an archive with it, `kind` from 0 on."""
    file = f"{exercise}/main.cpp"
    mac = [(f"__MACOSX/{exercise}/._main.cpp", b"\0\5\26\7"), (f"{exercise}/.DS_Store", b"Bud1")]
    kinds = [
        (f"{student}/{file}", lambda: content),
        (f"{student}.zip", lambda: _zip([(file, content)])),
        (f"{student}.zip", lambda: _zip([(f"{exercise}/", b""), (file, content)], zipfile.ZIP_STORED)),
        (f"{student}.zip", lambda: _zip([(file, content), *mac])),
        (f"{student}.zip", lambda: _zip([(file, content), (f"{exercise}/notes: done.txt", b"thanks"),
                                         (f"{exercise}/gr\u00f6\u00dfe.txt", b"x")])),
        (f"{student}.tar.gz", lambda: _tar([(file, content)], "w:gz")),
        (f"{student}.tar", lambda: _tar([(f"./{file}", content)], "w")),
    ]
    path, make = kinds[kind % len(kinds)]
    return path, make()

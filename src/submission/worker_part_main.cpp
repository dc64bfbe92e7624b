// rex-worker-part ORDER.toml: called by the build, once for each exercise; see worker_part.h. The keys are
// the fields of WorkerPartOrder, written by rex_worker_part() in RexExercise.cmake.
#include <cstdio>

#include "base/toml_table.h"
#include "submission/worker_part.h"

namespace {

rex::submission::WorkerPartOrder readOrder(const char* file) {
  const auto order = rex::TomlTable::read(file, "order", "what the build has written");
  const auto paths = [&](const char* key) {
    const std::vector<std::string> texts = order.texts(key);
    return std::vector<std::filesystem::path>(texts.begin(), texts.end());
  };
  return {.exercise = order.text("exercise"),
          .groups = order.text("groups"),
          .worker = order.text("worker"),
          .objects = paths("objects"),
          .functions = order.texts("functions"),
          .libraries = paths("libraries"),
          .compiler = order.text("compiler"),
          .linkFlags = order.texts("link_flags"),
          .objcopy = order.text("objcopy"),
          .nm = order.text("nm"),
          .folder = order.text("folder")};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: rex-worker-part ORDER.toml\n", stderr);
    return 64;
  }
  try {
    rex::submission::linkWorkerParts(readOrder(argv[1]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

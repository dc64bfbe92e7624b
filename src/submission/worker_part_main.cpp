// rex-worker-part: called by the build, once for each exercise; see worker_part.h.
#include <cstdio>

#include <CLI/CLI.hpp>

#include "base/error.h"
#include "base/lines.h"
#include "base/text_file.h"
#include "submission/worker_part.h"

int main(int argc, char** argv) {
  rex::grading::WorkerPartOrder order;
  std::string objects;
  CLI::App app("Links the part of the library that the worker of an exercise contains");
  app.add_option("--exercise", order.exercise, "folder of the exercise")->required();
  app.add_option("--groups", order.groups, "file with groups of functions")->required();
  app.add_option("--worker", order.worker, "object file of the worker's loop")->required();
  app.add_option("--objects", objects, "file with the library's object files, one per line")->required();
  app.add_option("--compiler", order.compiler, "compiler that links")->required();
  app.add_option("--objcopy", order.objcopy, "objcopy, which hides names")->required();
  app.add_option("--nm", order.nm, "nm, which lists names")->required();
  app.add_option("--libraries", order.libraries, "external libraries that the library needs");
  app.add_option("--functions", order.functions, "the student's functions that the loop calls")->required();
  app.add_option("--folder", order.folder, "folder to write to")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    const std::string list = rex::readTextFile(objects);
    for (const std::string_view line : rex::splitLines(list))
      if (!line.empty()) order.objects.emplace_back(line);
    rex::grading::linkWorkerParts(order);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

#include "cli/option_table_internal.h"
#include "cli/robot/robot_options_internal.h"

namespace rex::cli {

void addSceneFile(CLI::App* command, const std::string& name, std::filesystem::path& file) {
  command->add_option(name, file, "an .ors, .urdf or MuJoCo .xml file, or a scene such as man")
      ->type_name("")
      ->required();
}

void addReading(CLI::App* command, ReadOptions& reading) {
  addOptions(
      command,
      {{"--assets", reading.assetRoot, "DIR",
        "folder of all meshes (default: the one above the scene's folder)"},
       {"--allow-missing-meshes", reading.allowMissingMeshes, "use boxes for meshes that cannot be found"},
       {"--strict", reading.strict, "refuse faults of a file instead of repairing them"},
       {"--srdf", reading.srdf, "FILE",
        "which links of a .urdf may collide (default: the .srdf beside it or in ../srdf)"},
       OptionRow([&reading](CLI::App* app) {
         return app
             ->add_option_function<std::string>(
                 "--up-axis",
                 [&reading](const std::string& which) {
                   reading.upAxis =
                       choose<UpAxis>("--up-axis", which,
                                      {{"respected", UpAxis::kRespected}, {"ignored", UpAxis::kIgnored}});
                 },
                 "of Collada meshes: respected or ignored (default: ignored in .urdf, as in ROS)")
             ->type_name("WHICH");
       }),
       {"--free-base", reading.freeBase, "let the root of a .urdf move freely"}});
}

void addRenderOptions(CLI::App* command, RenderOptions& options) {
  addOptions(command,
             {{"--q", options.postures, "POSTURE",
               "all numbers, joint=number,..., or key:NAME or state:NAME; several: a motion through them"},
              {"--motion", options.motion, "FILE", "a motion: a posture per line, with or without a time"},
              {"--duration",
               options.seconds,
               {0.04, 600},
               "S",
               fmt::format("time from each --q to the next (default: {:g})", RenderPlan{}.seconds)},
              {"--camera", options.cameras, "VIEW",
               "front, back, left, right, top, x,y,z or eye@target; may be repeated"},
              {"--trace", options.traces, "BODY", "draw the path of this body as a line"},
              {"--caption", options.caption, "TEXT", "text in the top left corner, or title of a page"},
              {"--size", options.size, "WxH",
               fmt::format("pixels of one picture (default: {}, pages: {})", kPictureSize, kPageSize)},
              {"--shapes", options.scene.shapes, "WHICH", "which shapes to draw: visible, contact or all"},
              {"--textures", options.scene.reading.textures, "paint meshes with their textures"},
              {"--show", options.show, "WHAT",
               fmt::format("color, depth or segmentation (default: {})", kUsualShow)},
              {"--aa", options.antiAliasing, "KIND",
               "anti-aliasing: none, fxaa or msaa4 (default: msaa4, films: fxaa)"}});
}

void addFilmOptions(CLI::App* command, RenderOptions& film) {
  addOptions(command,
             {{"--camera", film.cameras, "VIEW", "as for `rex render`; may be repeated"},
              {"--size", film.size, "WxH", fmt::format("pixels of the film (default: {})", kPictureSize)}});
}

void addFilmSpeed(CLI::App* command, double& speed) {
  addOptions(command,
             {{"--speed", speed, {1e-3, 1e3}, "X", "speed of the film, 2: twice that of the motion"}});
}

void addPosture(CLI::App* command, std::string& posture) {
  addOptions(command, {{"--q", posture, "POSTURE",
                        "all numbers, joint=number,..., 0, file, or key:NAME or state:NAME of the file"}});
}

void requireGiven(const char* option, const std::string& value, const char* command) {
  if (!value.empty()) return;
  throw UsageError(
      {.what = fmt::format("{} is required; `rex {} --help` explains the options", option, command)});
}

void addJson(CLI::App* command, bool& json) { addOptions(command, {{"--json", json, "print JSON"}}); }

void addGl(CLI::App* command, std::string& gl) {
  command->add_option("--gl", gl, fmt::format("OpenGL backend: auto, egl, osmesa or gpu (default: {})", gl))
      ->type_name("NAME")
      ->envname("REX_GL");
}

}  // namespace rex::cli

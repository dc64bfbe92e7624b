#include "cli/option_value_internal.h"
#include "cli/robot/robot_options_internal.h"

namespace rex::cli {

void addSceneFile(CLI::App* command, const std::string& name, std::filesystem::path& file) {
  command->add_option(name, file, "an .ors, .urdf or MuJoCo .xml file, or a scene such as man")
      ->type_name("")
      ->required();
}

void addReading(CLI::App* command, ReadOptions& reading) {
  command
      ->add_option("--assets", reading.assetRoot,
                   "folder of all meshes (default: the one above the scene's folder)")
      ->type_name("DIR");
  command->add_flag("--allow-missing-meshes", reading.allowMissingMeshes,
                    "use boxes for meshes that cannot be found");
  command->add_flag("--strict", reading.strict, "refuse faults of a file instead of repairing them");
  command
      ->add_option("--srdf", reading.srdf,
                   "which links of a .urdf may collide (default: the .srdf beside it)")
      ->type_name("FILE");
  command
      ->add_option_function<std::string>(
          "--up-axis",
          [&reading](const std::string& which) {
            reading.upAxis = choose<UpAxis>(
                "--up-axis", which, {{"respected", UpAxis::kRespected}, {"ignored", UpAxis::kIgnored}});
          },
          "of Collada meshes: respected or ignored (default: ignored in .urdf, as in ROS)")
      ->type_name("WHICH");
  command->add_flag("--free-base", reading.freeBase, "let the root of a .urdf move freely");
}

void addRenderOptions(CLI::App* command, RenderOptions& options) {
  const auto list = [&](const char* name, std::vector<std::string>& values, const char* type,
                        const char* help) {
    command->add_option(name, values, help)->allow_extra_args(false)->type_name(type);
  };
  list("--q", options.postures, "POSTURE",
       "all numbers, or joint=number,...; several: a motion through them");
  command->add_option("--motion", options.motion, "a motion: a posture per line, with or without a time")
      ->type_name("FILE");
  command->add_option("--seconds", options.seconds, "time from each --q to the next (default: 2)")
      ->type_name("S");
  list("--camera", options.cameras, "VIEW",
       "front, back, left, right, top, x,y,z or eye@target; may be repeated");
  list("--trace", options.traces, "BODY", "draw the path of this body as a line");
  command->add_option("--caption", options.caption, "text in the top left corner, or title of a page")
      ->type_name("TEXT");
  command->add_option("--size", options.size, "pixels of one picture (default: 640x480, pages: 800x600)")
      ->type_name("WxH");
  command
      ->add_option("--shapes", options.scene.shapes,
                   "which shapes to draw: visible, contact or all (default: visible)")
      ->type_name("WHICH");
  command->add_flag("--textures", options.scene.reading.textures, "paint meshes with their textures");
  command->add_option("--show", options.show, "color, depth or segmentation (default: color)")
      ->type_name("WHAT");
  command
      ->add_option("--aa", options.antiAliasing,
                   "anti-aliasing: none, fxaa or msaa4 (default: msaa4, films: fxaa)")
      ->type_name("KIND");
}

void addFilmOptions(CLI::App* command, RenderOptions& film) {
  command->add_option("--camera", film.cameras, "as for `rex render`; may be repeated")
      ->allow_extra_args(false)
      ->type_name("VIEW");
  command->add_option("--size", film.size, "pixels of the film (default: 640x480)")->type_name("WxH");
}

void addFilmSpeed(CLI::App* command, double& speed) {
  command->add_option("--speed", speed, "speed of the film, 2: twice that of the motion (default: 1)")
      ->type_name("X");
}

void addPosture(CLI::App* command, std::string& posture) {
  command->add_option("--q", posture, "all numbers, joint=number,..., 0, or file (default: file)")
      ->type_name("POSTURE");
}

void addJson(CLI::App* command, bool& json) { command->add_flag("--json", json, "print JSON"); }

void addGl(CLI::App* command, std::string& gl) {
  command->add_option("--gl", gl, "OpenGL backend: auto, osmesa or egl (default: auto)")
      ->type_name("NAME")
      ->envname("REX_GL");
}

}  // namespace rex::cli

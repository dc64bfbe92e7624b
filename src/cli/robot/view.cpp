#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/folders.h"
#include "base/interruption.h"
#include "cli/command_table.h"
#include "cli/numbers.h"
#include "cli/option_table_internal.h"
#include "cli/out_folder.h"
#include "cli/robot/posture_option.h"
#include "cli/robot/robot_options_internal.h"
#include "cli/robot/scene_option.h"
#include "cli/robot/view_film.h"
#include "cli/terminal.h"
#include "live/live_page.h"
#include "live/live_server.h"
#include "live/live_session.h"
#include "live/open_browser.h"

namespace rex::cli {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::microseconds;

struct ViewOptions {
  SceneOption scene{};
  std::string posture = "file";  ///< see parsePosture()
  int port = 0;
  std::string bind = "127.0.0.1";
  bool noBrowser = false;
};

void offerRecording(LiveServer& server, LiveSession& session, ViewFilm& film) {
  if (session.takeFilmWish()) session.tell(film.draw());
  if (const std::optional<ViewFilm::Drawn> drawn = film.takeDrawn()) {
    session.tell(drawn->text);
    if (!drawn->bytes.empty()) server.offer("film.mp4", {"video/mp4", drawn->bytes}), session.addFilm();
  }
  const std::optional<LiveRecording> recording = session.takeRecording();
  if (!recording) return;
  const std::string table = toTable(session.model(), *recording);
  film.setMotion(table);
  server.offer("motion.csv", {"text/csv; charset=utf-8", table});
  session.tell("The recording is ready: save it below \"Record\".");
  try {
    server.offer("replay.html", {"application/octet-stream", toReplay(session.model(), *recording)});
  } catch (const Error& error) {
    session.tell(error.what());
  }
}

// Obeys and shows until the user ends it. While nothing moves, it waits.
[[noreturn]] void serve(LiveServer& server, LiveSession& session, ViewFilm& film) {
  constexpr microseconds kTick{16667}, kPause{200000};
  std::string shown;
  Clock::time_point last = Clock::now(), next = last;
  for (;;) {
    throwIfInterrupted();
    const microseconds left = std::chrono::duration_cast<microseconds>(next - Clock::now());
    const bool wasMoving = session.isMoving();
    const auto messages = server.takeMessages(wasMoving ? std::max(left, microseconds(0)) : kPause);
    for (const std::string& message : messages) {
      try {
        session.obey(message);
      } catch (const Error& error) {
        session.tell(error.what());
      }
    }
    const Clock::time_point now = Clock::now();
    if (!wasMoving) last = now, next = now;
    if (session.isMoving() && now >= next) {
      session.advance(std::chrono::duration<double>(now - last).count());
      last = now, next = std::max(next + kTick, now);
    }
    offerRecording(server, session, film);
    std::string frame = session.frame();
    if (frame != shown) server.publish(frame);
    shown = std::move(frame);
  }
}

ExitCode view(const Project& project, const ViewOptions& options) {
  SceneSpec spec = loadSpec(project, options.scene);
  const std::filesystem::path file = sceneFilePath(project, options.scene);
  spec.name = file.filename().string();  // its ending says where robots face
  const Model model = asWrongUse([&] { return compile(spec); });
  const Eigen::VectorXd q = parsePosture(model, options.posture);
  LiveSession session = asWrongUse([&] { return LiveSession(spec, q); });
  const HeldSignals held;
  const PrivateFolder folder(temporaryFolder());
  const auto server = asWrongUse([&] {
    return std::make_unique<LiveServer>(LiveServerOptions{.address = options.bind, .port = options.port});
  });
  offerLivePage(*server);
  server->offer("scene.json", {"application/json", session.description()});
  server->offer("scene.glb", {"model/gltf-binary", session.glb()});
  say(server->url());
  const std::string more = bringToUser(*server, options.noBrowser ? nullptr : &folder);
  if (!more.empty()) say(more);
  say("press Ctrl-C to end");
  std::fflush(stdout);
  ViewFilm film(session.model(), sceneFacing(file), folder.path());
  try {
    serve(*server, session, film);
  } catch (const Interrupted&) {
    return ExitCode::kFull;  // as the user wants it
  }
}

}  // namespace

void addView(CLI::App* command, Action& action) {
  const auto options = std::make_shared<ViewOptions>();
  command->footer(
      "Examples:\n  scripts/rex view man\n  scripts/rex view my_robot.urdf --q 0 --port 8080\n\n"
      "Sliders move the joints, the mouse drags and pushes bodies, a simulation shows how they\n"
      "move; share/doc/commands.md explains the page. The first line is its address, with a token\n"
      "that keeps others out; nobody else should see it. Over ssh, a line says how to forward\n"
      "the port. Ctrl-C ends it.");
  addSceneFile(command, "SCENE", options->scene.file);
  addPosture(command, options->posture);
  addOptions(command,
             {{"--port", options->port, {0, 65535}, "N", "port of the page, 0: one that is free"},
              {"--bind", options->bind, "ADDRESS", "address to serve, by default to this machine only"},
              {"--no-browser", options->noBrowser, "do not open a browser"}});
  addReading(command, options->scene.reading);
  command->callback(
      [&action, options] { action = [options](const Project& p) { return view(p, *options); }; });
}

}  // namespace rex::cli

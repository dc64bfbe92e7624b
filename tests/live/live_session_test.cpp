#include "live/live_session.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/rng.h"
#include "formats/scene_file.h"
#include "support/paths.h"

namespace rex::live_session_test {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

SceneSpec specOf(const std::string& name) {
  return readScene(homeFolder().string() + "/data/robots/" + name).spec;
}

LiveSession sessionOf(const std::string& name) {
  const SceneSpec spec = specOf(name);
  return LiveSession(spec, compile(spec).initialPositions());
}

Json frameOf(const LiveSession& session) { return Json::parse(session.frame()); }

std::string refusalOf(LiveSession& session, const std::string& message) {
  try {
    session.obey(message);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(LiveSession, MovesToPosturesWithinTheLimits) {
  LiveSession session = sessionOf("arm3.ors");
  session.obey(R"([{"do": "move", "q": {"1": 0.5}}, {"do": "move", "q": {"2": 1e9}}])");
  EXPECT_EQ(session.state().q[1], 0.5);
  EXPECT_EQ(session.state().q[2], std::min(1e9, session.model().upperLimits()[2]));
  EXPECT_EQ(frameOf(session)["q"][1], 0.5);
  session.obey(R"([{"do": "home"}])");
  EXPECT_EQ(session.state().q, session.model().initialPositions());
  EXPECT_FALSE(session.isMoving());
}

TEST(LiveSession, GoesHomeToAPostureOfTheFile) {
  SceneSpec spec = specOf("arm3.ors");
  spec.postures.push_back({.name = "key:home", .joints = {{spec.joints[0].name, Eigen::VectorXd::Ones(1)}}});
  const Model model = compile(spec);
  LiveSession session(spec, model.initialPositions());
  EXPECT_EQ(Json::parse(session.description())["postures"], Json({"key:home"}));
  session.obey(R"([{"do": "home", "posture": "key:home"}])");
  EXPECT_EQ(session.state().q, model.posture("key:home"));
  EXPECT_NE(session.state().q, model.initialPositions());
  session.obey(R"([{"do": "home"}])");
  EXPECT_EQ(session.state().q, model.initialPositions());
  EXPECT_THAT(refusalOf(session, R"([{"do": "home", "posture": "key:hom"}])"), HasSubstr("key:home"));
}

TEST(LiveSession, PutsAFreeBaseBack) {
  const std::string file = homeFolder().string() + "/data/robots/humanoid/humanoid.urdf";
  const SceneSpec spec = readScene(file, {.freeBase = true}).spec;
  const Eigen::VectorXd home = compile(spec).initialPositions();
  LiveSession session(spec, home);
  session.obey(R"([{"do": "run", "on": true}])");
  for (int tick = 0; tick < 30; ++tick) session.advance(1 / 60.);
  EXPECT_LT(session.state().q[2], home[2] - 0.5) << "it falls";
  session.obey(R"([{"do": "home"}])");
  EXPECT_EQ(session.state().q, home);
  EXPECT_TRUE(session.state().v.isZero());
  EXPECT_TRUE(session.isMoving()) << "and falls again";
}

TEST(LiveSession, DragsUntilNobodyRenewsIt) {
  LiveSession session = sessionOf("arm3.ors");
  const BodyId last = session.model().bodiesInFileOrder().back();
  const Eigen::Vector3d at = forwardKinematics(session.model(), session.state().q)[last].p;
  const Json to = {at.x() + 0.05, at.y() + 0.05, at.z()};
  session.obey(
      Json::array({{{"do", "drag"}, {"body", static_cast<int>(last)}, {"point", {0, 0, 0}}, {"to", to}}})
          .dump());
  for (int tick = 0; tick < 30; ++tick) session.advance(1 / 60.);
  EXPECT_TRUE(session.isMoving());
  EXPECT_TRUE(frameOf(session).contains("drag"));
  for (int tick = 0; tick < 40; ++tick) session.advance(1 / 60.);
  EXPECT_FALSE(session.isMoving());
  EXPECT_FALSE(frameOf(session).contains("drag"));
}

TEST(LiveSession, FallsWhenFreeAndStaysWhenHeld) {
  for (const bool isHeld : {false, true}) {
    LiveSession session = sessionOf("arm3.ors");
    session.obey(R"([{"do": "move", "q": [0.4, 0.3, 0.2]}])");
    const Eigen::VectorXd q = session.state().q;
    session.obey(
        std::string(R"([{"do": "settings", "gravity": true, "floor": false, "friction": 0.6, "hold": ")") +
        (isHeld ? "gravity" : "free") + R"("}, {"do": "run", "on": true}])");
    for (int tick = 0; tick < 60; ++tick) session.advance(1 / 60.);
    EXPECT_NEAR(session.state().time, 1, 0.02);
    const double moved = (session.state().q - q).norm();
    EXPECT_EQ(moved < 1e-3, isHeld);
    EXPECT_EQ(moved > 0.1, !isHeld);
    EXPECT_TRUE(frameOf(session).contains("energy"));
    session.obey(R"([{"do": "stop"}])");
    EXPECT_EQ(session.state().time, 0);
    EXPECT_FALSE(frameOf(session)["simulates"].get<bool>());
  }
}

TEST(LiveSession, IsPushedAndFollowsSlidersWhileHeld) {
  LiveSession session = sessionOf("arm3.ors");
  const BodyId last = session.model().bodiesInFileOrder().back();
  session.obey(R"([{"do": "run", "on": true}])");
  const Eigen::VectorXd q = session.state().q;
  for (int tick = 0; tick < 30; ++tick) {
    session.obey(Json::array({{{"do", "push"},
                               {"body", static_cast<int>(last)},
                               {"point", {0, 0, 0}},
                               {"force", {30, 0, 30}}}})
                     .dump());
    session.advance(1 / 60.);
  }
  EXPECT_GT((session.state().q - q).norm(), 1e-4);
  EXPECT_TRUE(frameOf(session).contains("push"));
  session.obey(R"([{"do": "release"}, {"do": "move", "q": {"0": 0.3}}])");
  for (int tick = 0; tick < 120; ++tick) session.advance(1 / 60.);
  EXPECT_NEAR(session.state().q[0], 0.3, 1e-2);
}

TEST(LiveSession, SimulatesStepByStep) {
  LiveSession session = sessionOf("arm3.ors");
  session.obey(R"([{"do": "step"}, {"do": "step"}])");
  EXPECT_NEAR(session.state().time, 0.02, 1e-12);
  session.advance(1 / 60.);
  EXPECT_NEAR(session.state().time, 0.02, 1e-12);
}

TEST(LiveSession, ShowsNearShapes) {
  LiveSession session = sessionOf("pegInAHole.ors");
  session.obey(R"([{"do": "contacts", "show": true, "avoid": false}])");
  EXPECT_TRUE(frameOf(session)["contacts"].is_array());
}

TEST(LiveSession, RecordsForAReplayAndATable) {
  LiveSession session = sessionOf("arm3.ors");
  session.obey(R"([{"do": "record", "on": true}])");
  for (int tick = 0; tick < 60; ++tick) {
    session.obey("[{\"do\": \"move\", \"q\": {\"0\": " + std::to_string(0.01 * tick) + "}}]");
    session.advance(1 / 60.);
  }
  EXPECT_FALSE(session.takeRecording());
  session.obey(R"([{"do": "record", "on": false}])");
  const std::optional<LiveRecording> recording = session.takeRecording();
  ASSERT_TRUE(recording);
  EXPECT_NEAR(static_cast<double>(recording->times.size()), 31, 1);
  EXPECT_THAT(toTable(session.model(), *recording), HasSubstr("time,"));
  EXPECT_THAT(toReplay(session.model(), *recording), HasSubstr("<html"));
  EXPECT_FALSE(session.takeFilmWish());
  session.obey(R"([{"do": "film"}])");
  EXPECT_TRUE(session.takeFilmWish());
  EXPECT_FALSE(session.takeFilmWish());
  EXPECT_FALSE(frameOf(session).contains("film"));
  session.addFilm();
  EXPECT_EQ(frameOf(session)["film"], 1);
}

TEST(LiveSession, EndsLongRecordings) {
  LiveSession session = sessionOf("arm3.ors");
  session.obey(R"([{"do": "record", "on": true}])");
  for (int tick = 0; tick < 1210; ++tick) session.advance(0.1);
  EXPECT_TRUE(session.takeRecording());
  EXPECT_THAT(session.frame(), HasSubstr("The recording ended after 120 seconds."));
}

TEST(LiveSession, TellsWhatItCannotSimulate) {
  const SceneSpec spec = parseScene(
                             "body a {}\nbody b {}\njoint j (a b) { type=0 }\n"
                             "shape (b) { type=0 size=[.1 .1 .1 0] }\n",
                             "massless.ors")
                             .spec;
  LiveSession session(spec, compile(spec).initialPositions());
  EXPECT_NE(refusalOf(session, R"([{"do": "run", "on": true}])"), "accepted");
  EXPECT_FALSE(frameOf(session)["runs"].get<bool>());
}

TEST(LiveSession, RefusesWhatIsWrong) {
  LiveSession session = sessionOf("arm3.ors");
  const std::string start = session.frame();
  const auto refused = [&](const std::string& message) { return refusalOf(session, message); };
  EXPECT_THAT(refused("{"), HasSubstr("found no list in JSON"));
  EXPECT_THAT(refused("[3]"), HasSubstr("wanted a list of objects"));
  EXPECT_THAT(refused("[{}]"), HasSubstr("do: found no text"));
  EXPECT_THAT(refused(R"([{"do": "fly"}])"),
              HasSubstr("do: found 'fly', wanted something that the page can do"));
  EXPECT_THAT(refused(R"([{"do": "move"}])"), HasSubstr("q: found no list or object"));
  EXPECT_THAT(refused(R"([{"do": "move", "q": [1]}])"), HasSubstr("found 1 numbers, wanted 3 numbers"));
  EXPECT_THAT(refused(R"([{"do": "move", "q": [1, 2, null]}])"), HasSubstr("wanted finite numbers"));
  EXPECT_THAT(refused(R"([{"do": "move", "q": {"9": 1}}])"), HasSubstr("found '9', wanted 0 to 2"));
  EXPECT_THAT(refused(R"([{"do": "move", "q": {"1": "x"}}])"), HasSubstr("wanted finite numbers"));
  EXPECT_THAT(refused(R"([{"do": "drag", "body": 99}])"), HasSubstr("body: found 99, wanted 0 to"));
  EXPECT_THAT(refused(R"([{"do": "drag", "body": 1, "point": 3}])"), HasSubstr("point: found no list"));
  EXPECT_THAT(refused(R"([{"do": "drag", "body": 1, "point": [0,0,0], "to": [0,0,0], "turn": [0,0,0,0]}])"),
              HasSubstr("turn: found a quaternion of length zero"));
  EXPECT_THAT(refused(R"([{"do": "run", "on": 1}])"), HasSubstr("on: found neither true nor false"));
  session.obey(R"([{"do": "stop"}])");
  EXPECT_THAT(refused(R"([{"do": "speed", "value": "fast"}])"), HasSubstr("value: found no finite number"));
  const std::string settings = R"([{"do": "settings", "gravity": true, "floor": true, )";
  EXPECT_THAT(refused(settings + R"("height": 1e9, "friction": 1, "hold": "pd"}])"),
              HasSubstr("height: found out of range"));
  EXPECT_THAT(refused(settings + R"("height": 0, "friction": -1, "hold": "pd"}])"),
              HasSubstr("friction: found out of range"));
  EXPECT_THAT(refused(settings + R"("height": 0, "friction": 1, "hold": "glue"}])"),
              HasSubstr("hold: found 'glue'"));
  EXPECT_EQ(session.frame(), start);
  session.obey(R"([{"do": "run", "on": true}])");
  EXPECT_THAT(refused(R"([{"do": "drag", "body": 1, "point": [0,0,0], "to": [0,0,0]}])"),
              HasSubstr("wanted a push"));
}

TEST(LiveSession, RefusesAQuaternionOfLengthZero) {
  const SceneSpec spec = parseScene(
                             "body a { mass=1 }\nbody b { mass=1 }\njoint j (a b) { type=free }\n"
                             "shape (b) { type=0 size=[.1 .1 .1 0] }\n",
                             "free.ors")
                             .spec;
  LiveSession session(spec, compile(spec).initialPositions());
  ASSERT_EQ(session.model().nq(), 7);
  EXPECT_THAT(refusalOf(session, R"([{"do": "move", "q": [0,0,0,0,0,0,0]}])"),
              HasSubstr("a quaternion of length zero"));
}

TEST(LiveSession, SurvivesRandomEvents) {
  LiveSession session = sessionOf("man.ors");
  Rng rng(5);
  const std::vector<std::string> things = {"move", "home", "drag", "push",  "release",  "contacts", "record",
                                           "run",  "step", "stop", "speed", "settings", "?"};
  for (int k = 0; k < 400; ++k) {
    Json event = {{"do", things[static_cast<std::size_t>(rng.index(static_cast<int>(things.size())))]}};
    const auto three = [&] { return Json{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)}; };
    event["body"] = rng.index(20), event["point"] = three(), event["to"] = three(), event["force"] = three();
    event["q"] = {{std::to_string(rng.index(40)), rng.uniform(-4, 4)}};
    for (const char* flag : {"on", "show", "avoid", "gravity", "floor"}) event[flag] = rng.index(2) == 1;
    event["value"] = rng.uniform(-1, 3), event["height"] = rng.uniform(-2, 1),
    event["friction"] = rng.uniform(-1, 2);
    event["hold"] = std::vector<std::string>{"free", "pd", "gravity", "exact",
                                             "motor"}[static_cast<std::size_t>(rng.index(5))];
    static_cast<void>(refusalOf(session, Json::array({event}).dump()));
    session.advance(0.005);
    ASSERT_TRUE(session.state().q.allFinite());
    ASSERT_TRUE(Json::accept(session.frame()));
  }
}

}  // namespace rex::live_session_test

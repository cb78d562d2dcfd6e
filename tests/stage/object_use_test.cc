#include "shared/stage/object_use.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "shared/core/units.h"
#include "shared/stage/caption_file.h"
#include "shared/stage/object.h"
#include "shared/stage/viseme_file.h"
#include "tests/stage/test_props.h"

namespace lararium::stage {
namespace {

using ::testing::HasSubstr;

Result<ObjectUse> ParseUse(const std::string& fields) {
  const Prop prop = test::MakeChest();
  return ParseObjectUse("{\"schema\": 1" + (fields.empty() ? "" : ", " + fields) + "}", prop,
                        "chest.object.json");
}

TEST(ObjectUse, ReadsWhatTheDocumentationShows) {
  const auto parsed = ParseObjectUse(R"({"schema": 1,
     "states": ["closed", "open"],
     "parts": {"lid": {"hinge": [1, 0, 0], "limits": [0, 100]}, "body": {"states": ["open"]}},
     "grips": {"knob": {"part": "lid", "at": [0, 0.04, 0], "palm": [0, -1, 0], "fingers": [0, 0, 1],
                        "hand": "either", "pose": "pinch"}},
     "places": {"front": {"at": [0, -0.55], "heading": 180}},
     "surfaces": {"top": {"spots": [{"at": [0.2, 0.8, 0], "heading": 90, "place": "front"}]}},
     "actions": {"open": {"from": ["closed"], "to": "open", "hands": {"right": "knob"}, "duration": 1.5,
                          "moves": [{"part": "lid", "to": 95, "begin": 0.2, "end": 1.4}],
                          "sound": "lid"}},
     "footprint": {"outline": [[-0.3, -0.3], [0.3, -0.3], [0.3, 0.3], [-0.3, 0.3]]},
     "capacity": 1,
     "queue": {"at": [0.6, -1.2], "heading": 180, "step": [0.3, -0.7]}})",
                                     test::MakeChest(), "jar.object.json");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_NEAR(parsed->joints[0].upper, 100.0f / 180.0f * kPiF, 1e-6f);
  EXPECT_NEAR(parsed->actions[0].moves[0].to, 95.0f / 180.0f * kPiF, 1e-6f);
  EXPECT_EQ(parsed->actions[0].from, 1u);
  EXPECT_EQ(parsed->actions[0].to, 1);
  EXPECT_EQ(parsed->actions[0].hands, (HandGrips{0, -1}));
  EXPECT_EQ(parsed->surfaces[0].spots[0].place, 0);
  EXPECT_EQ(parsed->shown[0].states, 2u);
  EXPECT_EQ(parsed->queue_step, glm::vec2(0.3f, -0.7f));
  EXPECT_EQ(parsed->footprint.outline.size(), 4u);
}

TEST(ObjectUse, AHandsAxesAreFingersAndPalm) {
  const auto parsed =
      ParseUse(R"("grips": {"g": {"at": [1, 2, 3], "palm": [0, 0, 2], "fingers": [3, 0, 0.5]}})");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  const glm::quat hand = parsed->grips[0].part_from_hand.rotation;
  const glm::vec3 fingers = hand * glm::vec3(0, 0, -1);
  const glm::vec3 palm = hand * glm::vec3(0, -1, 0);
  EXPECT_LT(glm::distance(fingers, glm::normalize(glm::vec3(3, 0, 0.5f))), 1e-5f);
  EXPECT_NEAR(glm::dot(fingers, palm), 0.0f, 1e-5f);
  EXPECT_GT(palm.z, 0.9f) << "as near to what was asked as a hand can be";
}

TEST(ObjectUse, WhatStaysIsInTheWayAndWhatIsCarriedIsNot) {
  EXPECT_EQ(ParseUse("")->footprint.outline.size(), 4u);
  EXPECT_TRUE(ParseUse(R"("footprint": {"outline": []})")->footprint.outline.empty());
  EXPECT_TRUE(
      ParseUse(R"("grips": {"g": {"at": [0, 0, 0], "palm": [0, -1, 0], "fingers": [0, 0, -1]}},
                       "carry": {"hands": {"right": "g"}})")
          ->footprint.outline.empty());
}

TEST(ObjectUse, ErrorsNameTheFieldAndTheRemedy) {
  const struct {
    const char* fields;
    const char* problem;
  } kMistakes[] = {
      {R"("colour": 1)", "chest.object.json: the field \"colour\" is not known"},
      {R"("states": [])", "at least one state"},
      {R"("states": ["a", "a"])", "every state needs a name"},
      {R"("parts": {"handle": {}})", "parts.handle: the model has no part of this name"},
      {R"("parts": {"lid": {"hinge": [0, 0, 0], "limits": [0, 1]}})", "must be a direction"},
      {R"("parts": {"lid": {"hinge": [0, 1, 0], "limits": [10, 1]}})", "limits must be"},
      {R"("parts": {"lid": {"hinge": [0, 1, 0]}})", "\"limits\" is missing"},
      {R"("grips": {"g": {"at": [0, 0, 0], "palm": [0, 1, 0], "fingers": [0, 1, 0]}})",
       "grips.g: palm and fingers must point in different directions"},
      {R"("grips": {"g": {"at": [0, 0, 0], "palm": [0, 1, 0], "fingers": [1, 0, 0], "pose": "claw"}})",
       "there is no pose 'claw'"},
      {R"("grips": {"g": {"at": [0, 0, 1e9], "palm": [0, 1, 0], "fingers": [1, 0, 0]}})",
       "out of range"},
      {R"("actions": {"open": {}})", "needs a place"},
      {R"("places": {"p": {"at": [0, 1]}}, "actions": {"open": {"places": []}})",
       "the list \"places\" is empty"},
      {R"("places": {"p": {"at": [0, 1]}}, "actions": {"open": {"to": "gone"}})",
       "there is no state 'gone'"},
      {R"("places": {"p": {"at": [0, 1]}}, "actions": {"open": {"hands": {"right": "x"}}})",
       "there is no grip 'x'"},
      {R"("places": {"p": {"at": [0, 1]}}, "actions": {"open": {"moves": [{"part": "lid", "to": 1}]}})",
       "this part has no joint"},
      {R"("places": {"p": {"at": [0, 1]}}, "actions": {"open": {"duration": -1}})", "duration"},
      {R"("places": {"p": {"at": [0, 1]}}, "actions": {"open": {"path": [{"t": 0.9, "at": [0,0,0]}, {"t": 0.5, "at": [0,0,0]}]}})",
       "path[1].t: must lie between"},
      {R"("footprint": {"outline": [[0, 0], [1, 0], [0, 1], [1, 1]]})", "convex"},
      {R"("carry": {"hands": {}})", "at least one hand must hold the object"},
      {R"("capacity": 0)", "capacity"},
      {R"("surfaces": {"top": {"spots": []}})", "spots"},
  };
  for (const auto& mistake : kMistakes) {
    const auto parsed = ParseUse(mistake.fields);
    ASSERT_FALSE(parsed.ok()) << mistake.fields;
    EXPECT_THAT(parsed.message(), HasSubstr(mistake.problem)) << mistake.fields;
    EXPECT_THAT(parsed.message(), ::testing::StartsWith("chest.object.json"));
  }
}

TEST(ObjectUse, SoundsOfActionsAndStates) {
  const auto parsed = ParseUse(R"("states": ["cold", "lit"],
      "places": {"front": {"at": [0, -0.5]}},
      "sounds": [{"name": "fire", "states": ["lit"], "at": [0, 0.4, 0], "gain_db": -3}],
      "actions": {"knock": {"sound": "knock"},
                  "stir": {"sound": {"name": "stir", "begin": 0.2, "end": 0.8, "loop": true}}})");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(parsed->actions[0].sound.name, "knock");
  EXPECT_FALSE(parsed->actions[0].sound.loops);
  EXPECT_EQ(parsed->actions[1].sound.name, "stir");
  EXPECT_FLOAT_EQ(parsed->actions[1].sound.end, 0.8f);
  EXPECT_TRUE(parsed->actions[1].sound.loops);
  ASSERT_EQ(parsed->sounds.size(), 1u);
  EXPECT_EQ(parsed->sounds[0].states, 2u);
  EXPECT_FLOAT_EQ(parsed->sounds[0].gain_db, -3.0f);
  EXPECT_FLOAT_EQ(parsed->sounds[0].position.y, 0.4f);

  EXPECT_THAT(ParseUse(R"("sounds": [{"name": "fire", "states": ["lit"]}])").message(),
              HasSubstr("lit"));
  EXPECT_THAT(ParseUse(R"("sounds": [{"name": "fire", "volume": 3}])").message(),
              HasSubstr("volume"));
  EXPECT_FALSE(ParseUse(R"("sounds": [{"name": "fire", "gain_db": 90}])").ok());
  EXPECT_FALSE(ParseUse(R"("sounds": [{}])").ok());
}

TEST(ObjectUse, AHingeTurnsAboutItsPartsOrigin) {
  const auto model = test::Model(test::MakeChest());
  const float quarter[] = {kPiF / 2.0f};
  // The lid's front edge, 0.4 m in front of the hinge, moves to 0.4 m above it.
  const glm::vec3 edge = ObjectFromPart(*model, quarter, 1) * glm::vec3(0.0f, 0.0f, -0.4f);
  EXPECT_LT(glm::distance(edge, glm::vec3(0.0f, 1.1f, 0.2f)), 1e-5f);
  Object object;
  object.model = model;
  ObjectState state = InitialState(object);
  state.joints[0] = quarter[0];
  std::array<glm::mat4, 2> places;
  std::array<uint8_t, 2> shown;
  const Pose there = {{5.0f, 0.0f, 0.0f}};
  ComputeParts(*model, state, there, places, shown);
  EXPECT_LT(glm::distance(glm::vec3(places[1] * glm::vec4(0.0f, 0.0f, -0.4f, 1.0f)),
                          glm::vec3(5.0f, 1.1f, 0.2f)),
            1e-5f);
}

TEST(ObjectLight, MovesWithItsPartAndBurnsInItsStates) {
  Object object;
  object.name = "lamp";
  object.model = test::Model(test::MakeLamp());
  object.seed = 5;
  ObjectState state = InitialState(object);
  const Pose pose = {{1.0f, 2.0f, 3.0f}, glm::angleAxis(0.5f * kPiF, glm::vec3(0, 0, 1))};
  std::vector<light::Lamp> lamps;
  AddLamps(object, state, pose, 0.7, lamps);
  ASSERT_EQ(lamps.size(), 1u);
  EXPECT_LT(glm::distance(lamps[0].position, glm::vec3(0.9f, 2.0f, 3.0f)), 1e-5f);
  EXPECT_EQ(lamps[0].radius, 0.02f);
  // The colour in the file is red and green of luminance 0.5; the flame's flicker scales it.
  EXPECT_FLOAT_EQ(lamps[0].intensity.r, 2.0f * lamps[0].intensity.g);
  const float luminance = glm::dot(lamps[0].intensity, glm::vec3(0.2126f, 0.7152f, 0.0722f));
  EXPECT_NEAR(luminance, 0.5f * light::Flicker(5, 0.7, 0.3f), 1e-5f);
  EXPECT_NEAR(GlowOf(object, state, 0.7), 2.0f * luminance, 1e-5f);
  state.state = 1;
  lamps.clear();
  AddLamps(object, state, pose, 0.7, lamps);
  EXPECT_TRUE(lamps.empty());
  EXPECT_EQ(GlowOf(object, state, 0.7), 0.0f);
}

TEST(ObjectLight, SaysWhatIsWrongWithIt) {
  const auto problem = [](const std::string& light) {
    return ParseUse("\"lights\": {\"fire\": " + light + "}").status().message();
  };
  EXPECT_EQ(problem(R"({"at": [0, 1, 0], "temperature": 1900, "intensity": 1, "radius": 0.1})"),
            "");
  EXPECT_THAT(problem(R"({"at": [0, 1, 0], "intensity": 1, "radius": 0.1})"),
              HasSubstr("\"colour\" or \"temperature\""));
  EXPECT_THAT(problem(R"({"at": [0, 1, 0], "colour": [0, 0, 0], "intensity": 1, "radius": 0.1})"),
              HasSubstr("not all 0"));
  EXPECT_THAT(problem(R"({"at": [0, 1, 0], "colour": [1, -1, 0], "intensity": 1, "radius": 0.1})"),
              HasSubstr("at least 0"));
  EXPECT_THAT(problem(R"({"at": [0, 1, 0], "temperature": 1900, "intensity": 1, "radius": 0})"),
              HasSubstr("radius"));
  EXPECT_THAT(problem(R"({"part": "wick", "at": [0, 1, 0], "temperature": 1900, "intensity": 1,
                          "radius": 0.1})"),
              HasSubstr("wick"));
}

TEST(Visemes, AreReadAsTheyWereWritten) {
  human::VisemeTrack track;
  track.duration = 1.25f;
  track.keys = {{0.0f, human::Viseme::kPP, 1.0f}, {0.5f, human::Viseme::kOu, 0.6f}};
  const auto read = ParseVisemes(FormatVisemes(track), "a.visemes.json");
  ASSERT_TRUE(read.ok()) << read.message();
  EXPECT_FLOAT_EQ(read->duration, track.duration);
  ASSERT_EQ(read->keys.size(), 2u);
  EXPECT_EQ(read->keys[1].viseme, human::Viseme::kOu);
  EXPECT_FLOAT_EQ(read->keys[1].strength, 0.6f);
}

TEST(Captions, AreReadAsTheyWereWrittenOrRefusedWithTheirPlace) {
  CaptionBook book;
  book.names["keeper"] = {{"en", "The keeper"}};
  book.lines["salvete"]["en"] = {{0.0, 1.5, "Greetings!"}, {1.5, 3.0, "What will\nyou have?"}};
  const auto read = ParseCaptions(FormatCaptions(book), "captions.json");
  ASSERT_TRUE(read.ok()) << read.message();
  EXPECT_EQ(*read, book);
  book.lines["salvete"]["en"][1].begin = 1.0;
  EXPECT_THAT(
      ParseCaptions(FormatCaptions(book), "captions.json").message(),
      HasSubstr("lines.salvete.en[1]: its time is empty or overlaps the caption before it"));
  book.lines["salvete"]["en"] = {{0.0, 1.0, "three\nrows\nthere"}};
  EXPECT_THAT(ParseCaptions(FormatCaptions(book), "captions.json").message(),
              HasSubstr("one or two lines"));
}

TEST(Visemes, ReadsTracksAndSaysWhatIsWrongWithThem) {
  const auto track = ParseVisemes(
      R"({"schema": 1, "duration": 1.25, "visemes": [{"t": 0, "viseme": "PP"}, {"t": 0.08, "viseme": "aa", "strength": 0.8}]})",
      "a.visemes.json");
  ASSERT_TRUE(track.ok()) << track.message();
  EXPECT_EQ(track->keys[1].viseme, human::Viseme::kAa);
  EXPECT_FLOAT_EQ(track->keys[1].strength, 0.8f);
  const struct {
    const char* text;
    const char* problem;
  } kMistakes[] = {
      {"{", "not valid JSON"},
      {R"({"schema": 2, "duration": 1, "visemes": []})", "schema"},
      {R"({"schema": 1, "duration": 1, "visemes": [{"t": 0, "viseme": "zz"}]})",
       "there is no viseme 'zz'"},
      {R"({"schema": 1, "duration": 1, "visemes": [{"t": 0.5, "viseme": "aa"}, {"t": 0.2, "viseme": "aa"}]})",
       "visemes[1]: begins before the one before it"},
      {R"({"schema": 1, "duration": 1, "visemes": [{"t": 2, "viseme": "aa"}]})", "time"},
  };
  for (const auto& mistake : kMistakes) {
    const auto parsed = ParseVisemes(mistake.text, "a.visemes.json");
    ASSERT_FALSE(parsed.ok()) << mistake.text;
    EXPECT_THAT(parsed.message(), HasSubstr(mistake.problem));
  }
}

}  // namespace
}  // namespace lararium::stage

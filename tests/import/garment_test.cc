// Tools for cutting garments: sheets, distance fields, draping, weaves, formulas, and the parsing
// of designs and patterns.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <opencv2/imgcodecs.hpp>

#include "editor/import/wardrobe/body_field.h"
#include "editor/import/wardrobe/drape.h"
#include "editor/import/wardrobe/fit.h"
#include "editor/import/wardrobe/formula.h"
#include "editor/import/wardrobe/garment_design.h"
#include "editor/import/wardrobe/garment_pattern.h"
#include "editor/import/wardrobe/posed_body.h"
#include "editor/import/wardrobe/sheet.h"
#include "editor/import/wardrobe/weave.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/core/json_fields.h"
#include "tests/support/test_files.h"

namespace lararium::import {
namespace {

constexpr float kRadius = 0.2f;

// A ball about the origin: rings of latitude, counter-clockwise from outside.
struct Ball {
  std::vector<glm::vec3> positions;
  std::vector<Triangle> triangles;
};

Ball MakeBall() {
  constexpr int kRings = 20;
  constexpr int kSides = 32;
  Sheet sheet;
  GridPanel grid;
  grid.columns = kSides + 1;
  grid.rows = kRings + 1;
  grid.flat = [](size_t column, size_t row) { return glm::vec2(column, row); };
  grid.place = [](size_t column, size_t row) {
    const float a = 6.2831853f * float(column % kSides) / kSides;
    const float b = 3.14159265f * float(row) / kRings;
    return kRadius * glm::vec3(std::sin(b) * std::sin(a), std::cos(b), std::sin(b) * std::cos(a));
  };
  AddPanel(sheet, grid, 0);
  std::vector<std::array<uint32_t, 2>> seam;
  for (uint32_t r = 0; r <= kRings; ++r) {
    seam.push_back({r * (kSides + 1), r * (kSides + 1) + kSides});
  }
  for (uint32_t c = 1; c < kSides; ++c) {
    seam.push_back({0, c});
    seam.push_back({kRings * (kSides + 1), kRings * (kSides + 1) + c});
  }
  Sew(sheet, seam);
  Ball ball{sheet.positions, {}};
  for (const Triangle& t : sheet.ParticleTriangles()) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
      ball.triangles.push_back(t);
    }
  }
  return ball;
}

BodyField FieldOfBall() {
  const Ball ball = MakeBall();
  BodyField field(ball.positions, 0.01f, 0.03f);
  field.Add(ball.positions, ball.triangles);
  field.Finish();
  return field;
}

// A level square of cloth with its middle above the origin.
Sheet Napkin(size_t side, float spacing, float height) {
  Sheet sheet;
  GridPanel grid;
  grid.columns = side;
  grid.rows = side;
  grid.flat = [=](size_t c, size_t r) { return spacing * glm::vec2(c, r); };
  grid.place = [=](size_t c, size_t r) {
    const float middle = 0.5f * float(side - 1);
    return glm::vec3(spacing * (float(c) - middle), height, spacing * (float(r) - middle));
  };
  AddPanel(sheet, grid, 0);
  return sheet;
}

TEST(Sheet, SewingMakesOneParticleOfTwoVertices) {
  Sheet sheet = Napkin(3, 0.1f, 0.0f);
  const std::array<uint32_t, 2> pair = {0, 2};
  Sew(sheet, {&pair, 1});
  EXPECT_EQ(sheet.positions.size(), 8u);
  EXPECT_EQ(sheet.flat.size(), 9u);
  EXPECT_EQ(sheet.particle[0], sheet.particle[2]);
  EXPECT_NEAR(sheet.positions[sheet.particle[0]].x, 0.0f, 1e-6f);
}

TEST(Sheet, SubdividedKeepsItsParticlesAndItsFlatArea) {
  const Sheet sheet = Napkin(5, 0.1f, 0.0f);
  std::vector<std::array<uint32_t, 2>> parents;
  const Sheet fine = Subdivided(sheet, &parents);
  EXPECT_EQ(fine.triangles.size(), 4 * sheet.triangles.size());
  EXPECT_EQ(fine.positions.size(), 81u);
  ASSERT_EQ(parents.size(), fine.positions.size());
  for (size_t p = 0; p < sheet.positions.size(); ++p) {
    EXPECT_EQ(fine.positions[p], sheet.positions[p]);
  }
  for (size_t p = 0; p < parents.size(); ++p) {
    const glm::vec3 middle =
        0.5f * (sheet.positions[parents[p][0]] + sheet.positions[parents[p][1]]);
    EXPECT_LT(glm::distance(fine.positions[p], middle), 1e-6f);
  }
  float area = 0.0f;
  for (const auto& [a, b, c] : fine.triangles) {
    const glm::vec2 u = fine.flat[b] - fine.flat[a];
    const glm::vec2 v = fine.flat[c] - fine.flat[a];
    area += 0.5f * std::abs(u.x * v.y - u.y * v.x);
  }
  EXPECT_NEAR(area, 0.16f, 1e-5f);
}

TEST(Sheet, BandsEndSharplyAndStaySewn) {
  Sheet sheet = Napkin(5, 0.1f, 0.0f);
  const size_t particles = sheet.positions.size();
  MarkBands(sheet, [](uint8_t, const glm::vec2& middle) { return middle.x < 0.2f; });
  EXPECT_EQ(sheet.flat.size(), 25u + 15u);
  EXPECT_EQ(sheet.positions.size(), particles);
  for (const Triangle& t : sheet.triangles) {
    EXPECT_EQ(sheet.panel[t[0]] & kBand, sheet.panel[t[1]] & kBand);
    EXPECT_EQ(sheet.panel[t[0]] & kBand, sheet.panel[t[2]] & kBand);
  }
  DropUnusedVertices(sheet);
  EXPECT_EQ(sheet.flat.size(), 15u + 15u);
  EXPECT_EQ(OpenEdges(sheet.ParticleTriangles()).size(), 16u);
}

TEST(Sheet, OpenEdgesAreItsRim) {
  EXPECT_EQ(OpenEdges(Napkin(5, 0.1f, 0.0f).ParticleTriangles()).size(), 16u);
}

TEST(BodyField, IsTheDistanceFromABall) {
  const BodyField field = FieldOfBall();
  for (const float r : {0.18f, 0.19f, 0.2f, 0.21f, 0.22f}) {
    for (const glm::vec3& d :
         {glm::vec3(1, 0, 0), glm::vec3(0.6f, 0.8f, 0), glm::vec3(0, -0.6f, 0.8f)}) {
      const FieldSample sample = field.Sample(r * d);
      EXPECT_NEAR(sample.distance, r - kRadius, 0.003f) << r;
      EXPECT_GT(glm::dot(sample.outward, d), 0.97f) << r;
    }
  }
}

TEST(BodyField, KnowsInsideFromOutsideFarFromTheSurface) {
  const BodyField field = FieldOfBall();
  EXPECT_LT(field.Sample(glm::vec3(0.0f)).distance, 0.0f);
  EXPECT_GT(field.Sample(glm::vec3(0.23f, 0.2f, 0.2f)).distance, 0.0f);
  EXPECT_GT(field.Sample(glm::vec3(5.0f)).distance, 0.0f);
}

TEST(Draper, ClothComesToRestOverABallWithoutEnteringIt) {
  Sheet sheet = Napkin(15, 0.04f, 0.24f);
  DrapeMaterial material;
  const NoProgress progress;
  Draper draper(sheet, material, progress);
  const BodyField field = FieldOfBall();
  draper.Run(200, field);
  float lowest = 1.0f;
  for (const glm::vec3& p : sheet.positions) {
    EXPECT_GT(glm::length(p), kRadius + material.gap - 0.004f);
    lowest = std::min(lowest, p.y);
  }
  EXPECT_LT(lowest, 0.0f) << "the corners hang down";
  double stretch = 0.0;
  for (const auto& [a, b, c] : sheet.triangles) {
    stretch += glm::distance(sheet.positions[a], sheet.positions[b]) /
               glm::distance(sheet.flat[a], sheet.flat[b]) / double(sheet.triangles.size());
  }
  EXPECT_NEAR(stretch, 1.0, 0.05);
}

TEST(Draper, ATetherHoldsWhatFalls) {
  Sheet sheet = Napkin(2, 0.1f, 0.0f);
  const NoProgress progress;
  Draper draper(sheet, {}, progress);
  draper.pins.push_back({0, sheet.positions[0], 1.0f});
  for (uint32_t p = 1; p < 4; ++p) {
    draper.Tether(p, 0, 0.15f);
  }
  const std::vector<glm::vec3> nothing = {glm::vec3(9.0f), glm::vec3(9.1f)};
  draper.Run(120, BodyField(nothing, 0.05f, 0.1f));
  for (uint32_t p = 1; p < 4; ++p) {
    EXPECT_LT(glm::distance(sheet.positions[p], sheet.positions[0]), 0.16f);
  }
}

TEST(Draper, ACancelledClothStaysWhereItIs) {
  class AlwaysCancelled : public NoProgress {
   public:
    bool Cancelled() const override { return true; }
  };
  Sheet sheet = Napkin(15, 0.04f, 0.24f);
  const std::vector<glm::vec3> before = sheet.positions;
  const AlwaysCancelled progress;
  Draper draper(sheet, {}, progress);
  draper.Run(200, FieldOfBall());
  EXPECT_EQ(sheet.positions, before);
}

TEST(HullRadius, OfASquareReachesItsSidesAndCorners) {
  const std::vector<glm::vec2> square = {{1, 1}, {1, -1}, {-1, -1}, {-1, 1}, {0.2f, 0.1f}};
  const std::vector<float> radius = HullRadius(square, glm::vec2(0.0f), 72);
  EXPECT_NEAR(radius[0], 1.0f, 0.01f);
  EXPECT_NEAR(radius[9], std::sqrt(2.0f), 0.01f);
}

float Computed(std::string_view text) {
  const auto formula = Formula::Parse(text, "test");
  EXPECT_TRUE(formula.ok()) << formula.message();
  return formula->Value([](std::string_view name) { return name == "hip" ? 0.9f : 0.5f; });
}

TEST(Formula, ComputesAsMathematicsDoes) {
  EXPECT_FLOAT_EQ(Computed("1 + 2 * 3 - 4 / 2"), 5.0f);
  EXPECT_FLOAT_EQ(Computed("8 - 4 - 2"), 2.0f);
  EXPECT_FLOAT_EQ(Computed("-(hip - knee) * 2"), -0.8f);
  EXPECT_FLOAT_EQ(Computed("mix(hip, knee, 0.25)"), 0.8f);
  EXPECT_FLOAT_EQ(Computed("if(hip > knee and not (knee >= hip), max(1, 2), 3)"), 2.0f);
  EXPECT_FLOAT_EQ(Computed("1 < 2 or 1 / 0 < 2"), 1.0f);
  EXPECT_FLOAT_EQ(Computed("smooth(0, 1, 0.25) + clamp(7, 0, 1)"), 1.15625f);
  EXPECT_FLOAT_EQ(Computed("notch + order * android"), 0.75f) << "names that begin as operators";
  EXPECT_FLOAT_EQ(Computed("hip >= 0.9 and 1 or 0 and 0"), 1.0f) << "\"and\" binds first";
}

TEST(Formula, SaysWhatIsWrongAndAtWhichCharacter) {
  const std::pair<std::string, const char*> cases[] = {
      {"", "a number or a name is expected at character 1"},
      {"1 +", "a number or a name is expected at character 4"},
      {"2 hip", "\"hip\" is not expected at character 3"},
      {"max(1)", "\"max\" wants more values at character 6"},
      {"max(1, 2, 3)", "\"max\" wants fewer values"},
      {"max(1, 2", "a \")\" is missing at character 9"},
      {"tan(1)", "\"tan\" is not expected at character 1"},
      {"1e999", "\"1e999\" is not expected"},
      {std::string(100, '('), "too many parentheses"},
      {std::string(100, '-') + "1", "\"-\" is not expected"},
      {std::string(401, ' '), "longer than 400"},
      {"hip; knee", "nothing like this is expected at character 4"},
      {"1, 2", "\",\" is not expected at character 2"},
      {"hip = 3", "nothing like this is expected at character 5"},
      {"hip < 1 ? 2 : 3", "nothing like this is expected at character 9"},
      {"\"hip\"", "nothing like this is expected at character 1"},
  };
  for (const auto& [text, expected] : cases) {
    const auto formula = Formula::Parse(text, "here");
    ASSERT_FALSE(formula.ok()) << text;
    EXPECT_TRUE(formula.message().starts_with("here")) << formula.message();
    EXPECT_NE(formula.message().find(expected), std::string::npos) << formula.message();
  }
}

Json TunicFile() { return *LoadJson(GarmentFile("tunic")); }

TEST(GarmentDesign, EveryGarmentOfTheLibraryIsRead) {
  EXPECT_GE(GarmentNames().size(), 6u);
  for (const std::string& name : GarmentNames()) {
    const auto design = LoadGarment(name);
    ASSERT_TRUE(design.ok()) << design.message();
    EXPECT_EQ(design->name, name);
    EXPECT_NE(design->certainty, stage::Certainty::kUnsaid);
  }
}

TEST(GarmentDesign, TheShirtOfTheHowToIsRead) {
  const auto page = ReadText(test::SourceDir() / "docs/how-to-make-a-garment.md");
  ASSERT_TRUE(page.ok()) << page.message();
  const size_t begin = page->find("```json") + 7;
  const std::string text = page->substr(begin, page->find("```", begin) - begin);
  const auto design = ParseGarment(text, "shirt/garment.json");
  ASSERT_TRUE(design.ok()) << design.message();
  EXPECT_EQ(design->name, "shirt");
  EXPECT_EQ(design->seams.size(), 4u);
}

TEST(GarmentDesign, ErrorsNameThePieceOrTheSeam) {
  const std::pair<Json, const char*> cases[] = {
      {{{"op", "replace"}, {"path", "/pieces/0/neck"}, {"value", "0.7 * sholder"}},
       "pieces[0].neck (piece \"front\"): \"sholder\" is no measure"},
      {{{"op", "replace"}, {"path", "/pieces/1/hem"}, {"value", "1 +"}}, "(piece \"back\")"},
      {{{"op", "remove"}, {"path", "/pieces/1/neck"}}, "pieces[1]"},
      {{{"op", "remove"}, {"path", "/pieces/1"}}, "one in front and one behind"},
      {{{"op", "replace"}, {"path", "/pieces/1/name"}, {"value", "front"}},
       "there are two pieces \"front\""},
      {{{"op", "replace"}, {"path", "/pieces/1/placed"}, {"value", "above"}},
       "piece \"back\" cannot be placed 'above'"},
      {{{"op", "replace"}, {"path", "/seams/0/from"}, {"value", "colour"}},
       "(seam \"left shoulder\"): \"colour\" is no measure"},
      {{{"op", "replace"}, {"path", "/seams/1/pieces/0"}, {"value", "sleeve"}},
       "seam \"right shoulder\" joins \"sleeve\", which is no piece"},
      {{{"op", "replace"}, {"path", "/seams/1/pieces/0"}, {"value", "back"}},
       "seam \"right shoulder\" does not join a piece in front with the one behind it"},
      {{{"op", "replace"}, {"path", "/seams/2/edge"}, {"value", "bottom"}},
       "seam \"left side\" cannot be along 'bottom'"},
      {{{"op", "add"}, {"path", "/sizes/neck"}, {"value", "arm + half_top"}}, ""},
      {{{"op", "add"}, {"path", "/sizes/half_top"}, {"value", "arm"}}, "depends on itself"},
      {{{"op", "add"}, {"path", "/sizes/girth"}, {"value", 1}}, "\"girth\" has two meanings"},
      {{{"op", "replace"}, {"path", "/fabric/colour"}, {"value", "ease"}},
       "no parameter with a colour"},
      {{{"op", "replace"}, {"path", "/certainty"}, {"value", "sure"}}, "write attested"},
      {{{"op", "add"}, {"path", "/pockets"}, {"value", 2}}, "pockets"},
  };
  for (const auto& [change, expected] : cases) {
    const std::string text = TunicFile().patch(Json::array({change})).dump();
    const auto design = ParseGarment(text, "garments/tunic/garment.json");
    if (*expected == '\0') {
      EXPECT_TRUE(design.ok()) << design.message();
      continue;
    }
    ASSERT_FALSE(design.ok()) << change;
    EXPECT_TRUE(design.message().starts_with("garments/tunic/garment.json")) << design.message();
    EXPECT_NE(design.message().find(expected), std::string::npos) << design.message();
  }
}

TEST(PieceFit, OneErrorNamesGarmentPieceFaultPlaceAndRemedy) {
  GarmentDesign design;
  design.file = "garments/coat/garment.json";
  PieceFit good;
  good.piece = "back";
  good.stretched_at = "left thigh, seam \"left side\"";
  good.inside_at = "waist";
  EXPECT_TRUE(CheckFit(std::vector<PieceFit>{good, good}, design).ok());
  const auto with = [&](auto change) {
    PieceFit bad = good;
    change(bad);
    return CheckFit(std::vector<PieceFit>{good, bad}, design).message();
  };
  const std::string begin = "garments/coat/garment.json: piece \"back\" ";
  const std::pair<std::string, const char*> cases[] = {
      {with([](PieceFit& fit) { fit.lost = 3; }), "has left the body with 3 points"},
      {with([](PieceFit& fit) { fit.stretch_most = 12.0f; }),
       "is stretched to 1200 % at the left thigh, seam \"left side\""},
      {with([](PieceFit& fit) { fit.stretch = std::nanf(""); }), "is stretched"},
      {with([](PieceFit& fit) { fit.area = 0.1f; }), "is crumpled to 10 % of its area"},
      {with([](PieceFit& fit) { fit.inside = 0.2f; }), "20 % of its points, deepest at the waist"},
  };
  for (const auto& [message, expected] : cases) {
    EXPECT_TRUE(message.starts_with(begin)) << message;
    EXPECT_NE(message.find(expected), std::string::npos) << message;
  }
}

Result<GarmentPattern> Parse(const std::string& text) {
  const Json json = *ParseJson(text, "test");
  return ParseFields<GarmentPattern>(JsonView(json, "garments[0]"));
}

TEST(GarmentPattern, ReadsWhatARecipeSays) {
  const auto pattern = Parse(
      R"({"name": "tunic", "length": "calf", "sleeve": "elbow", "belt": "cord", "ease": 1.8,
          "colour": "#ff0000", "stripes": "broad", "stripe_colour": "purple", "blouse": 0.1,
          "border": true, "wear": 0.7, "one_shoulder": true, "seed": 5})");
  ASSERT_TRUE(pattern.ok()) << pattern.message();
  EXPECT_EQ(pattern->design->name, "tunic");
  const std::map<std::string, float, std::less<>> numbers = {
      {"length", 1.45f},  {"sleeve", 1.0f}, {"belt", 0.014f}, {"ease", 1.8f},        {"wear", 0.7f},
      {"stripes", 0.07f}, {"blouse", 0.1f}, {"border", 1.0f}, {"one_shoulder", 1.0f}};
  EXPECT_EQ(pattern->numbers, numbers);
  EXPECT_EQ(pattern->Colour("colour"), glm::vec3(1, 0, 0));
  EXPECT_EQ(pattern->seed, 5u);
}

TEST(GarmentPattern, EveryNameHasAPlainPattern) {
  for (const std::string& name : GarmentNames()) {
    const auto pattern = Parse("{\"name\": \"" + name + "\"}");
    ASSERT_TRUE(pattern.ok()) << pattern.message();
    EXPECT_EQ(pattern->design->name, name);
  }
}

TEST(GarmentPattern, SaysWhatIsWrongWhereAndWhatIsRight) {
  const std::pair<const char*, const char*> cases[] = {
      {"[]", "must be an object"},
      {"{}", "name"},
      {R"({"name": "trousers"})", "choose one of: apron"},
      {R"({"name": "tunic", "colour": "mauve"})", "write #rrggbb or one of"},
      {R"({"name": "tunic", "colour": "#12345g"})", "no dye"},
      {R"({"name": "tunic", "length": "mini"})", "choose one of: thigh"},
      {R"({"name": "tunic", "length": -3})", "length"},
      {R"({"name": "tunic", "ease": 1e30})", "ease"},
      {R"({"name": "tunic", "seed": 1.5})", "seed"},
      {R"({"name": "tunic", "border": 1})", "border"},
      {R"({"name": "tunic", "lenght": "knee"})", "lenght"},
  };
  for (const auto& [text, expected] : cases) {
    const auto pattern = Parse(text);
    ASSERT_FALSE(pattern.ok()) << text;
    EXPECT_NE(pattern.message().find("garments[0]"), std::string::npos) << pattern.message();
    EXPECT_NE(pattern.message().find(expected), std::string::npos) << pattern.message();
  }
}

TEST(Weave, RepeatsWithoutASeamAndIsNearWhite) {
  const auto texture = WeaveColour(Weave::kWool, 3);
  ASSERT_TRUE(texture.ok()) << texture.message();
  EXPECT_TRUE(texture->Validate("weave").ok());
  const auto* bytes = reinterpret_cast<const uchar*>(texture->encoded.data());
  const cv::Mat image =
      cv::imdecode({bytes, static_cast<int>(texture->encoded.size())}, cv::IMREAD_GRAYSCALE);
  ASSERT_EQ(image.size(), cv::Size(512, 512));
  double sum = 0.0;
  double seam = 0.0;
  double inside = 0.0;
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 512; ++x) {
      sum += image.at<uchar>(y, x);
    }
    seam += std::abs(image.at<uchar>(y, 0) - image.at<uchar>(y, 511));
    inside += std::abs(image.at<uchar>(y, 200) - image.at<uchar>(y, 199));
  }
  EXPECT_GT(sum / (512.0 * 512.0), 200.0);
  EXPECT_LT(seam, 1.8 * inside + 512.0);
}

}  // namespace
}  // namespace lararium::import

#include "shared/core/json_fields.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "shared/core/json.h"

namespace lararium {
namespace {

enum class Colour { kRed, kGreen };
constexpr std::array<std::string_view, 2> kColours = {"red", "green"};

struct Wheel {
  float radius = 0.5f;
  std::optional<double> load;
};

void DescribeFields(Fields& fields, Wheel& wheel) {
  fields.Number("radius", wheel.radius, 0.1, 2.0);
  fields.Number("load", wheel.load, 0.0);
}

struct Cart {
  std::string name;
  Colour colour = Colour::kRed;
  bool covered = false;
  uint32_t seats = 2;
  std::array<double, 2> size = {3.0, 1.5};
  std::vector<Wheel> wheels;
  std::vector<std::string> owners;
  std::map<std::string, int> tolls;
  std::optional<Wheel> spare;
};

void DescribeFields(Fields& fields, Cart& cart) {
  fields.Schema(2, "is too new ({})", "update");
  fields.Text("name", cart.name, 8);
  fields.Choice(Optional("colour", cart.colour != Colour::kRed), cart.colour, kColours,
                "there is no colour '{}'", "use red or green");
  fields.Flag(Optional("covered", cart.covered), cart.covered);
  fields.Integer(Optional("seats"), cart.seats, 1, 9);
  fields.Numbers("size", cart.size);
  fields.List("wheels", cart.wheels, 4);
  fields.List(Optional("owners", !cart.owners.empty()), cart.owners, 2,
              [&](const FieldKey& key, std::string& owner) { fields.Text(key, owner); });
  fields.Entries(Optional("tolls", !cart.tolls.empty()), cart.tolls, 2, "must be two tolls",
                 [&](const FieldKey& key, int& toll) { fields.Integer(key, toll, 0, 100); });
  fields.Object("spare", cart.spare);
  fields.Require(cart.wheels.size() != 1, "falls over", "add a wheel");
}

Json Full() {
  return {{"schema", 2},
          {"name", "gig"},
          {"colour", "green"},
          {"covered", true},
          {"seats", 4},
          {"size", {2.0, 1.0}},
          {"wheels", {{{"radius", 0.5}}, {{"radius", 0.25}, {"load", 80.0}}}},
          {"owners", {"Publia"}},
          {"tolls", {{"gate", 3}, {"road", 1}}},
          {"spare", {{"radius", 1.0}}}};
}

std::string Problem(const Json& json, UnknownFields unknown = UnknownFields::kRefuse) {
  const Result<Cart> cart = ParseFields<Cart>(JsonView(json, "cart.json"), unknown);
  return cart.ok() ? "" : cart.message();
}

// The error of a full cart in which one value was replaced.
std::string ProblemWith(const char* pointer, const Json& value) {
  Json json = Full();
  json[Json::json_pointer(pointer)] = value;
  return Problem(json);
}

std::string ProblemWithout(const char* name) {
  Json json = Full();
  json.erase(name);
  return Problem(json);
}

TEST(JsonFields, WritesWhatItReads) {
  const Json json = Full();
  const Result<Cart> cart = ParseFields<Cart>(JsonView(json, "cart.json"));
  ASSERT_TRUE(cart.ok()) << cart.message();
  EXPECT_EQ(cart->colour, Colour::kGreen);
  EXPECT_EQ(cart->wheels[1].load, 80.0);
  EXPECT_FALSE(cart->wheels[0].load.has_value());
  EXPECT_EQ(cart->tolls.at("road"), 1);
  EXPECT_EQ(cart->spare->radius, 1.0f);
  EXPECT_EQ(FormatFields(*cart).dump(), json.dump());
}

TEST(JsonFields, LeavesOutWhatIsNotWritten) {
  EXPECT_EQ(FormatFields(Cart()).dump(),
            R"({"name":"","schema":2,"seats":2,"size":[3.0,1.5],"wheels":[]})");
}

TEST(JsonFields, WritingDoesNotTouchTheValue) {
  static constexpr Wheel kWheel{0.75f, 20.0};  // Lies in memory that cannot be written.
  EXPECT_EQ(FormatFields(kWheel).dump(), R"({"load":20.0,"radius":0.75})");
}

TEST(JsonFields, MissingOptionalFieldsKeepTheirDefaults) {
  const Result<Cart> cart = ParseFields<Cart>(
      R"({"schema": 2, "name": "gig", "size": [1, 1], "wheels": []})", "cart.json", DescribeFields);
  ASSERT_TRUE(cart.ok()) << cart.message();
  EXPECT_EQ(cart->seats, 2u);
  EXPECT_FALSE(cart->covered || cart->spare.has_value());
}

TEST(JsonFields, ErrorsNameTheFileAndTheField) {
  EXPECT_EQ(ProblemWithout("size"), "cart.json: the field \"size\" is missing");
  EXPECT_EQ(ProblemWith("/wheels/1/radius", 3.0).substr(0, 45),
            "cart.json: wheels[1].radius: must lie between");
  EXPECT_EQ(ProblemWith("/wheels/0", 1), "cart.json: wheels[0]: must be an object");
  EXPECT_EQ(ProblemWith("/owners/0", 1), "cart.json: owners[0]: must be a text");
  EXPECT_EQ(ProblemWith("/tolls", {{"a", 1}, {"b", 1}, {"c", 1}}),
            "cart.json: tolls: must be two tolls");
  EXPECT_EQ(ProblemWith("/tolls/gate", -1),
            "cart.json: tolls.gate: must be a whole number from 0 to 100");
  EXPECT_EQ(ProblemWith("/colour", "blue"),
            "cart.json: there is no colour 'blue'; use red or green");
  EXPECT_EQ(ProblemWith("/wheels", {{{"radius", 0.5}}}), "cart.json: falls over; add a wheel");
  EXPECT_EQ(ProblemWith("/schema", 3), "cart.json: is too new (3); update");
  EXPECT_EQ(Problem(Json::array()), "cart.json: must be an object");
  EXPECT_EQ(ParseFields<Cart>("{", "cart.json", DescribeFields)
                .message()
                .rfind("cart.json: not valid JSON", 0),
            0u);
}

TEST(JsonFields, KeepsTheFirstError) {
  Json json = Full();
  json["seats"] = 99;
  json["size"] = "big";
  EXPECT_EQ(Problem(json), "cart.json: seats: must be a whole number from 1 to 9");
}

TEST(JsonFields, NamesUnknownFieldsAndWhatIsKnown) {
  EXPECT_EQ(ProblemWith("/spare/colour", "red"),
            "cart.json: spare: the field \"colour\" is not known; correct its spelling (known are "
            "radius, load), or use a newer version of Lararium");
  Json json = Full();
  json["colour of the cover"] = "red";
  EXPECT_EQ(Problem(json, UnknownFields::kIgnore), "");
}

TEST(JsonFields, AMisspelledFieldIsUnknownRatherThanMissing) {
  Json json = Full();
  json.erase("wheels");
  json["wheel"] = Json::array();
  EXPECT_NE(Problem(json).find("\"wheel\" is not known"), std::string::npos) << Problem(json);
  EXPECT_EQ(Problem(json, UnknownFields::kIgnore), "cart.json: the field \"wheels\" is missing");
}

}  // namespace
}  // namespace lararium

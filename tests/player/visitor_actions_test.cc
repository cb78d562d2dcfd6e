#include "player/kiosk/visitor_actions.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "shared/show/show_content.h"

namespace lararium::player {
namespace {

Result<Buttons> ParseActions(std::string_view text) {
  return ParseFields<Buttons>(
      R"({"buttons": )" + std::string(text) + "}", "device.json",
      [](Fields& fields, Buttons& buttons) { DescribeButtons(fields, "buttons", buttons); });
}

TEST(Buttons, OfKeyboardsAndControllersDoTheSame) {
  const Buttons buttons;
  EXPECT_EQ(buttons.ActionOf("page_up"), Action::kLouder);
  EXPECT_EQ(buttons.ActionOf("pad_up"), Action::kLouder);
  EXPECT_EQ(buttons.ActionOf("m"), Action::kMenu);
  EXPECT_EQ(buttons.ActionOf("pad_start"), Action::kMenu);
  EXPECT_EQ(buttons.ActionOf("pad_a"), std::nullopt) << "the drama's";
}

TEST(Buttons, OfADeviceFileReplaceThoseOfTheirActionOnly) {
  const Buttons buttons = ParseActions(R"({"menu": ["pad_a", "l"], "restart": []})").value();
  EXPECT_EQ(buttons.ActionOf("pad_a"), Action::kMenu);
  EXPECT_EQ(buttons.ActionOf(kHandMenu), std::nullopt) << "in place of the usual ones";
  EXPECT_EQ(ParseActions(R"({"captions": ["hand_select"]})")->ActionOf(kHandSelect),
            Action::kCaptions);
  EXPECT_EQ(buttons.ActionOf("l"), Action::kMenu) << "no longer the language's";
  EXPECT_EQ(buttons.ActionOf("pad_start"), std::nullopt);
  EXPECT_EQ(buttons.ActionOf("home"), std::nullopt);
  EXPECT_EQ(buttons.ActionOf("pad_left"), Action::kLanguage);
  EXPECT_EQ(ParseActions("{}").value(), Buttons());
}

TEST(Buttons, MistakesAreOneErrorThatNamesThem) {
  const auto problem = [](std::string_view text) { return ParseActions(text).status().message(); };
  EXPECT_NE(problem(R"({"jump": ["a"]})").find("no action \"jump\""), std::string::npos);
  EXPECT_NE(problem(R"({"menu": ["pad_z"]})").find("no button \"pad_z\""), std::string::npos);
  EXPECT_NE(problem(R"({"menu": [""]})").find("no button \"\""), std::string::npos);
  EXPECT_NE(problem(R"({"menu": ["m"], "louder": ["m"]})").find("another action's"),
            std::string::npos);
  EXPECT_FALSE(ParseActions(R"({"menu": "m"})").ok());
  EXPECT_FALSE(ParseActions("[1]").ok());
}

TEST(Choices, VolumeStaysWithinItsRange) {
  Choices choices;
  const std::vector<std::string> none;
  Choose(Action::kLouder, {none, none}, choices);
  EXPECT_EQ(choices.volume, 1.0);
  for (int i = 0; i < 20; ++i) {
    Choose(Action::kQuieter, {none, none}, choices);
  }
  EXPECT_EQ(choices.volume, 0.0);
}

TEST(Choices, LanguagesComeRoundAndCaptionsCanBeOff) {
  Choices choices;
  const std::vector<std::string> spoken = {"la", "en"};
  const std::vector<std::string> captions = {"la", "en", "it"};
  Choose(Action::kLanguage, {spoken, captions}, choices);
  EXPECT_EQ(choices.language, "en") << "the first is the author's";
  Choose(Action::kLanguage, {spoken, captions}, choices);
  EXPECT_EQ(choices.language, "la");
  for (const std::string& expected :
       {std::string("en"), std::string("it"), std::string(show::kNoCaptions), std::string("la")}) {
    Choose(Action::kCaptions, {spoken, captions}, choices);
    EXPECT_EQ(choices.captions, expected);
  }
}

TEST(Choices, SizesAndContrastsOfCaptionsComeRound) {
  Choices choices;
  const std::vector<std::string> none;
  for (const render::CaptionSize expected :
       {render::CaptionSize::kLarge, render::CaptionSize::kLargest, render::CaptionSize::kNormal}) {
    Choose(Action::kCaptionSize, {none, none}, choices);
    EXPECT_EQ(choices.caption_style.size, expected);
  }
  Choose(Action::kCaptionContrast, {none, none}, choices);
  EXPECT_TRUE(choices.caption_style.is_high());
  Choose(Action::kCaptionContrast, {none, none}, choices);
  EXPECT_EQ(choices, Choices());
}

TEST(Choices, DescriptionsAndReducedMotionAreSwitched) {
  Choices choices;
  const std::vector<std::string> none;
  Choose(Action::kDescriptions, {none, none, false}, choices);
  EXPECT_EQ(choices, Choices()) << "a show without any";
  Choose(Action::kDescriptions, {none, none, true}, choices);
  EXPECT_TRUE(choices.descriptions);
  Choose(Action::kReducedMotion, {none, none, true}, choices);
  EXPECT_TRUE(choices.reduced_motion);
  Choose(Action::kDescriptions, {none, none, true}, choices);
  Choose(Action::kReducedMotion, {none, none, true}, choices);
  EXPECT_EQ(choices, Choices());
}

TEST(Choices, WhatAShowLacksCannotBeChosen) {
  Choices choices;
  const std::vector<std::string> none;
  Choose(Action::kLanguage, {none, none}, choices);
  Choose(Action::kCaptions, {none, none}, choices);
  Choose(Action::kRestart, {none, none}, choices);
  EXPECT_EQ(choices, Choices());
}

}  // namespace
}  // namespace lararium::player

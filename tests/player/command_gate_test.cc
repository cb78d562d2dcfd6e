#include "player/fleet/command_gate.h"

#include <gmock/gmock.h>

#include "player/staff/staff_messages.h"

namespace lararium::player {
namespace {

using ::testing::HasSubstr;
using namespace std::chrono_literals;

constexpr char kFromBeginning[] = R"({"do": "restart"})";
const CommandGate::Clock::time_point kNow = CommandGate::Clock::time_point() + 1h;

TEST(CommandGate, PassesWhatTheStaffPageAccepts) {
  CommandGate gate;
  EXPECT_TRUE(gate.Check(kFromBeginning, false, kNow).ok());
  EXPECT_TRUE(gate.Check(R"({"do": "volume", "value": 0.5})", false, kNow).ok());
  EXPECT_EQ(gate.refused(), 0);
}

TEST(CommandGate, RefusesWhatIsNoCommandTooLongOrKept) {
  CommandGate gate;
  EXPECT_THAT(gate.Check("", false, kNow).message(), HasSubstr("command of the fleet"));
  EXPECT_THAT(gate.Check(R"({"do": "format"})", false, kNow).message(), HasSubstr("no such thing"));
  EXPECT_THAT(gate.Check(kFromBeginning + std::string(1024, ' '), false, kNow).message(),
              HasSubstr("1024 bytes"));
  EXPECT_THAT(gate.Check(kFromBeginning, true, kNow).message(), HasSubstr("kept it"));
  EXPECT_EQ(gate.refused(), 4);
}

TEST(CommandGate, EveryCutAndEveryChangedByteOfACommandEndsWell) {
  const std::string command = R"({"do": "volume", "value": 0.5})";
  for (size_t i = 0; i < command.size(); ++i) {
    CommandGate gate;
    EXPECT_FALSE(gate.Check(command.substr(0, i), false, kNow).ok()) << i;
    for (int value = 0; value < 256; ++value) {
      std::string changed = command;
      changed[i] = static_cast<char>(value);
      CommandGate other;
      const bool passes = other.Check(changed, false, kNow).ok();
      EXPECT_EQ(passes, ParseStaffCommand(changed).ok()) << changed;
      EXPECT_EQ(other.refused(), passes ? 0 : 1);
    }
  }
}

TEST(CommandGate, LimitsHowManyComeInASecond) {
  CommandGate gate;
  for (int i = 0; i < CommandGate::kMostInASecond; ++i) {
    EXPECT_TRUE(gate.Check(kFromBeginning, false, kNow + i * 10ms).ok());
  }
  EXPECT_THAT(gate.Check(kFromBeginning, false, kNow + 900ms).message(), HasSubstr("too many"));
  EXPECT_TRUE(gate.Check(kFromBeginning, false, kNow + 1000ms).ok());
}

TEST(CommandGate, TellsOfTheFirstThatIsRefusedAndOfEachHundredthAfterIt) {
  CommandGate gate;
  int told = 0;
  for (int i = 0; i < 250; ++i) {
    EXPECT_FALSE(gate.Check("nonsense", false, kNow).ok());
    told += gate.tells() ? 1 : 0;
  }
  EXPECT_EQ(told, 3);
}

}  // namespace
}  // namespace lararium::player

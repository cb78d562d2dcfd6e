#include "player/staff/staff_pin.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

using ::testing::HasSubstr;

TEST(StaffPin, IsTheFirstLineOfItsFile) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "pin";
  std::ofstream(file) << "738291\r\nfor the desk\n";
  ::chmod(file.c_str(), 0640);
  const auto pin = StaffPin::Load(file);
  ASSERT_TRUE(pin.ok()) << pin.message();
  EXPECT_TRUE(pin->Is("738291"));
  for (const char* wrong : {"", "738290", "73829", "7382911", "738291\r", "for the desk"}) {
    EXPECT_FALSE(pin->Is(wrong)) << wrong;
  }
}

TEST(StaffPin, MayStandBehindAByteOrderMark) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "pin";
  for (const std::string& text : {std::string("\xEF\xBB\xBF"
                                              "738291 \r\n"),
                                  std::string("\xFF\xFE"
                                              "7\0"
                                              "3\0"
                                              "8\0"
                                              "2\0"
                                              "9\0"
                                              "1\0",
                                              14)}) {
    std::ofstream(file) << text;
    ::chmod(file.c_str(), 0600);
    const auto pin = StaffPin::Load(file);
    ASSERT_TRUE(pin.ok()) << pin.message();
    EXPECT_TRUE(pin->Is("738291"));
  }
}

TEST(StaffPin, OfAFileThatAnybodyReadsIsRefused) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "pin";
  std::ofstream(file) << "738291\n";
  ::chmod(file.c_str(), 0644);
  EXPECT_THAT(StaffPin::Load(file).message(), HasSubstr("chmod 600"));
  EXPECT_FALSE(StaffPin::Load(folder / "none").ok());
}

TEST(StaffPin, ShortLongAndStrangeOnesAreRefused) {
  for (const std::string& text :
       {std::string(), std::string("12345"), std::string(65, '1'), std::string("123 456"),
        std::string("12345\xc3\xa9"), std::string("12345\0", 6)}) {
    EXPECT_FALSE(StaffPin::Create(text, "pin").ok()) << text;
  }
}

TEST(PinLock, EachWrongTryBeyondTheFreeOnesDoublesTheWait) {
  PinLock lock;
  for (int i = 1; i < PinLock::kFreeTries; ++i) {
    lock.Wrong(10.0);
    EXPECT_EQ(lock.LockedFor(10.0), 0.0);
  }
  lock.Wrong(10.0);
  EXPECT_EQ(lock.LockedFor(10.0), PinLock::kFirstSeconds);
  EXPECT_EQ(lock.LockedFor(71.0), 0.0);
  lock.Wrong(71.0);
  EXPECT_EQ(lock.LockedFor(71.0), 2 * PinLock::kFirstSeconds);
  for (int i = 0; i < 100; ++i) {
    lock.Wrong(1e4);
  }
  EXPECT_EQ(lock.LockedFor(1e4), PinLock::kMostSeconds);
  lock.Right();
  EXPECT_EQ(lock.LockedFor(1e4), 0.0);
}

}  // namespace
}  // namespace lararium::player

#include "player/kiosk/power_sensors.h"

#include <gtest/gtest.h>

#include <fstream>
#include <semaphore>

#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

// A fake /sys.
class PowerSensorsTest : public ::testing::Test {
 protected:
  void Put(const std::string& path, const std::string& text) {
    const std::filesystem::path file = folder_.path() / "class" / path;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::trunc) << text;
  }
  show::PowerState Read() { return ReadPower(folder_.path()); }

  test::TemporaryFolder folder_;
};

TEST_F(PowerSensorsTest, WhereNothingIsKnownNothingIsSaid) {
  EXPECT_FALSE(Read().celsius);
  EXPECT_FALSE(Read().battery);
  EXPECT_FALSE(ReadPower("/nowhere").celsius);
}

TEST_F(PowerSensorsTest, TheHottestZoneCounts) {
  Put("thermal/thermal_zone0/temp", "41500\n");
  Put("thermal/thermal_zone1/temp", "78250\n");
  Put("thermal/thermal_zone2/temp", "-274000\n");
  Put("thermal/thermal_zone3/temp", "nonsense\n");
  Put("thermal/thermal_zone4/temp", "");
  Put("thermal/cooling_device0/temp", "99000\n");
  EXPECT_EQ(Read().celsius, 78.25);
}

TEST_F(PowerSensorsTest, OnlyAnEmptyingBatteryCounts) {
  Put("power_supply/AC/type", "Mains\n");
  Put("power_supply/BAT0/type", "Battery\n");
  Put("power_supply/BAT0/status", "Discharging\n");
  Put("power_supply/BAT0/capacity", "37\n");
  EXPECT_EQ(Read().battery, 0.37);
  Put("power_supply/mouse/type", "Battery\n");
  Put("power_supply/mouse/scope", "Device\n");
  Put("power_supply/mouse/status", "Discharging\n");
  Put("power_supply/mouse/capacity", "3\n");
  EXPECT_EQ(Read().battery, 0.37) << "a mouse's battery is another matter";
  Put("power_supply/BAT0/status", "Charging\n");
  EXPECT_FALSE(Read().battery);
}

TEST_F(PowerSensorsTest, ABatteryIsKnownWhileItIsChargedToo) {
  EXPECT_FALSE(ReadBattery(folder_.path()));
  Put("power_supply/BAT0/type", "Battery\n");
  Put("power_supply/BAT0/status", "Charging\n");
  Put("power_supply/BAT0/capacity", "80\n");
  ASSERT_TRUE(ReadBattery(folder_.path()));
  EXPECT_EQ(ReadBattery(folder_.path())->share, 0.8);
  EXPECT_TRUE(ReadBattery(folder_.path())->charging);
  Put("power_supply/BAT1/type", "Battery\n");
  Put("power_supply/BAT1/status", "Discharging\n");
  Put("power_supply/BAT1/capacity", "20\n");
  EXPECT_EQ(ReadBattery(folder_.path())->share, 0.2) << "the emptiest";
  EXPECT_FALSE(ReadBattery(folder_.path())->charging);
}

TEST(PowerWatch, TellsWhatWasReadOnceAndDoesNotWait) {
  std::counting_semaphore<> go_on(0);
  int reads = 0;
  PowerWatch watch(1e-3, [&] {
    go_on.acquire();
    show::PowerState power;
    power.celsius = 40.0 + ++reads;
    return power;
  });
  EXPECT_FALSE(watch.Take()) << "a sensor takes its time";
  go_on.release();
  std::optional<show::PowerState> power;
  while (!power) {
    power = watch.Take();
  }
  EXPECT_EQ(power->celsius, 41.0);
  EXPECT_FALSE(watch.Take()) << "told already";
  go_on.release(1000);
}

}  // namespace
}  // namespace lararium::player

#include "shared/group/group_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "shared/core/random.h"

namespace lararium::group {
namespace {

constexpr int64_t kSecond = 1'000'000;
constexpr int64_t kAhead = 123'456'789;  // The group's clock is ahead.

// Exchanges times five times a second. The group's clock is faster by `drift`, and each way takes
// `shortest` and an exponential delay more.
class GroupClockTest : public ::testing::Test {
 protected:
  int64_t GroupAt(int64_t own) const {
    return own + kAhead + std::llround(drift_ * static_cast<double>(own));
  }
  int64_t Way() { return shortest_ - std::llround(jitter_ * std::log(1.0 - random_.Uniform())); }
  void Exchange() {
    const int64_t there = own_ + Way();
    const int64_t answered = there + 90'000;
    const int64_t back = answered + Way();
    clock_.Add({own_, GroupAt(there), GroupAt(answered), back});
    own_ = back + 110'000;
  }
  int64_t Error() const { return std::abs(clock_.GroupTime(own_) - GroupAt(own_)); }

  GroupClock clock_;
  Random random_ = Random(3);
  int64_t own_ = 77 * kSecond;
  double drift_ = 40e-6;
  int64_t shortest_ = 40'000;
  double jitter_ = 15'000.0;
};

TEST_F(GroupClockTest, KnowsTheGroupsTimeToHalfOfTheJitterAtOnce) {
  EXPECT_FALSE(clock_.known());
  Exchange();
  EXPECT_TRUE(clock_.known());
  EXPECT_LT(Error(), 60'000);
}

TEST_F(GroupClockTest, KnowsTimeAndDriftInSpiteOfJitter) {
  while (own_ < 200 * kSecond) {
    Exchange();
  }
  EXPECT_LT(Error(), 5'000);
  EXPECT_NEAR(clock_.drift(), drift_, 30e-6);
  const int64_t later = own_ + 30 * kSecond;  // The broker is away until then.
  EXPECT_LT(std::abs(clock_.GroupTime(later) - GroupAt(later)), 6'000);
  EXPECT_NEAR(static_cast<double>(clock_.OwnTime(clock_.GroupTime(later))),
              static_cast<double>(later), 2.0);
}

TEST_F(GroupClockTest, IgnoresAThirdOfExchangesThatWaitedOneWay) {
  for (int i = 0; own_ < 120 * kSecond; ++i) {
    const int64_t shortest = shortest_;
    shortest_ += i % 3 == 0 ? 400'000 : 0;
    Exchange();
    shortest_ = shortest;
  }
  EXPECT_LT(Error(), 8'000);
}

TEST_F(GroupClockTest, IgnoresExchangesThatCannotBeTrue) {
  Exchange();
  const int64_t known = clock_.GroupTime(own_);
  clock_.Add({own_, 5, 4, own_ + 10});                      // Answered before it was received.
  clock_.Add({own_ + 20, 0, 1000, own_ + 30});              // Faster than light.
  clock_.Add({own_, 0, 10, own_ + 100 * kSecond});          // Much too late.
  clock_.Add({own_ - 10 * kSecond, kAhead, kAhead, own_});  // Sent before the last one.
  EXPECT_EQ(clock_.GroupTime(own_), known);
}

TEST_F(GroupClockTest, TakesTheTimeOfAnotherGroup) {
  for (int i = 0; i < 100; ++i) {
    Exchange();
  }
  clock_.Add({own_, 1000 * kSecond, 1000 * kSecond, own_ + 20'000});
  EXPECT_NEAR(static_cast<double>(clock_.GroupTime(own_ + 20'000)), 1000.01e6, 1000.0);
}

}  // namespace
}  // namespace lararium::group

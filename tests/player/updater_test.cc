#include "player/updates/updater.h"

#include <curl/curl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "shared/bundle/bundle.h"
#include "shared/bundle/bundle_writer.h"
#include "shared/bundle/publishing.h"
#include "shared/core/file.h"
#include "shared/core/random.h"
#include "tests/bundle/example_show.h"
#include "tests/player/range_server.h"
#include "tests/support/test_files.h"
#include "tests/support/thorough.h"

namespace lararium::player {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;

class UpdaterTest : public ::testing::Test {
 protected:
  UpdaterTest() {
    curl_global_init(CURL_GLOBAL_DEFAULT);
    Random random(1);
    for (char& byte : map_) {
      byte = static_cast<char>(random.Uniform(0.0, 256.0));
    }
    Write(shipped_, "-- shipped");
    options_.server.url = server_.url();
    options_.server.bytes_per_second = 1e9;
    options_.trusted = key_.public_key();
    options_.folder = around_ / "updates";
    options_.shipped = shipped_;
    options_.interval_seconds = 0.01;
  }

  static std::span<const std::byte> Bytes(std::string_view text) {
    return std::as_bytes(std::span(text));
  }
  void Write(const fs::path& file, const std::string& drama) const {
    const Status written =
        bundle::WriteBundle(file, test::ExampleManifest(),
                            {{"drama.lua", Bytes(drama)},
                             {"places/0/scene.larscene", Bytes(map_)},
                             {"places/0/occluder0.larmesh", Bytes(std::string_view())},
                             {"cast/0.larhuman", Bytes(drama)}},
                            &key_);
    ASSERT_TRUE(written.ok()) << written.message();
  }
  bundle::Publication Publish(const std::string& drama, uint64_t serial) {
    Write(around_ / "unpublished.larshow", drama);
    return bundle::Publish(around_ / "unpublished.larshow", served_, key_, serial).value();
  }
  Result<bool> Fetch() const { return FetchNewest(options_, store_); }
  // The drama of the show that would be played. The show is verified.
  std::string Playable() const {
    const auto show = bundle::Bundle::Open(store_.Newest().file, {.trusted = options_.trusted});
    EXPECT_TRUE(show.ok()) << show.message();
    const std::span<const std::byte> drama = show->member("drama.lua").value();
    return {reinterpret_cast<const char*>(drama.data()), drama.size()};
  }

  test::TemporaryFolder around_;
  fs::path shipped_ = around_ / "shipped.larshow";
  fs::path served_ = around_ / "served";
  std::string map_ = std::string(3'000'000, '\0');
  bundle::SecretKey key_ = bundle::MakeSecretKey();
  test::RangeServer server_{served_};
  UpdaterOptions options_;
  UpdateStore store_{around_ / "updates", shipped_};
};

TEST_F(UpdaterTest, FetchesOnlyWhatHasChanged) {
  const bundle::Publication published = Publish("-- corrected", 10);
  ASSERT_TRUE(Fetch().value());
  EXPECT_EQ(Playable(), "-- corrected");
  EXPECT_EQ(store_.Newest().serial, 10u);
  EXPECT_EQ(*ReadBytes(store_.Newest().file), *ReadBytes(served_ / published.file()));
  EXPECT_LT(server_.sent(), 10'000u);  // The show has 3 MB.
  EXPECT_FALSE(Fetch().value());
}

TEST_F(UpdaterTest, FetchesNothingIfTheShowAtHandIsTheNewest) {
  Publish("-- shipped", 10);
  EXPECT_FALSE(Fetch().value());
  EXPECT_EQ(server_.sent(), ReadText(served_ / "newest.json")->size());
}

TEST_F(UpdaterTest, FetchesAllIfTheShowAtHandCannotBeRead) {
  ASSERT_TRUE(WriteFileAtomically(shipped_, std::string_view("no bundle")).ok());
  Publish("-- corrected", 10);
  ASSERT_TRUE(Fetch().value());
  EXPECT_EQ(Playable(), "-- corrected");
  EXPECT_GT(server_.sent(), 3'000'000u);
}

TEST_F(UpdaterTest, ContinuesWhereItWasCut) {
  map_[5] ^= 1;
  Publish("-- corrected", 10);
  server_.cut_after = 700'000;
  int tries = 0;
  for (Result<bool> fetched = Fetch(); !fetched.ok(); fetched = Fetch()) {
    EXPECT_THAT(fetched.message(), HasSubstr("cannot be fetched"));
    EXPECT_EQ(Playable(), "-- shipped");
    ASSERT_LT(++tries, 10);
  }
  EXPECT_EQ(Playable(), "-- corrected");
  EXPECT_GE(tries, 4);
  EXPECT_LT(server_.sent(), 3'100'000u);
}

TEST_F(UpdaterTest, AnAlteredShowIsNotPlayedAndIsFetchedAgain) {
  map_[5] ^= 1;
  Publish("-- corrected", 10);
  server_.altered = 2'000'000;
  EXPECT_THAT(Fetch().message(), HasSubstr("was changed"));
  EXPECT_EQ(Playable(), "-- shipped");
  server_.altered = -1;
  EXPECT_TRUE(Fetch().value());
  EXPECT_EQ(Playable(), "-- corrected");
}

TEST_F(UpdaterTest, AnOlderShowIsRefused) {
  Publish("-- old", 10);
  const std::string old_list = *ReadText(served_ / "newest.json");
  Publish("-- new", 20);
  ASSERT_TRUE(Fetch().value());
  ASSERT_TRUE(WriteFileAtomically(served_ / "newest.json", old_list).ok());
  EXPECT_THAT(Fetch().message(), HasSubstr("offers show 10, which is older than 20"));
  EXPECT_EQ(Playable(), "-- new");
}

TEST_F(UpdaterTest, AListOfAnotherKeyIsRefused) {
  Publish("-- new", 10);
  options_.trusted = bundle::MakeSecretKey().public_key();
  EXPECT_THAT(Fetch().message(), HasSubstr("is not signed with the trusted key"));
  EXPECT_FALSE(FileExists(options_.folder));
}

TEST_F(UpdaterTest, WhatAServerCannotDoIsSaid) {
  EXPECT_THAT(Fetch().message(), HasSubstr("the server answers 404"));
  Publish("-- new", 10);
  server_.knows_ranges = false;
  EXPECT_THAT(Fetch().message(), HasSubstr("sends only whole files"));
  ASSERT_TRUE(WriteFileAtomically(served_ / "newest.json", std::string(70'000, 'x')).ok());
  EXPECT_THAT(Fetch().message(), HasSubstr("is larger than it may be"));
  options_.server.url = "http://127.0.0.1:1/";
  EXPECT_THAT(Fetch().message(), HasSubstr("cannot be fetched"));
}

TEST_F(UpdaterTest, AShowThatFailedIsNotFetchedAgain) {
  Publish("-- crashes", 10);
  ASSERT_TRUE(Fetch().value());
  EXPECT_EQ(store_.Choose(3, *MakeSilentLog()).serial, 0u);
  EXPECT_FALSE(Fetch().value());
  Publish("-- corrected", 11);
  EXPECT_TRUE(Fetch().value());
  EXPECT_EQ(Playable(), "-- corrected");
}

TEST_F(UpdaterTest, AProcessThatWaitsLooksAtOnceWhenItIsAskedTo) {
  options_.interval_seconds = 1000.0;
  Publish("-- first", 1);
  const auto log = MakeSilentLog();
  const auto updater = Updater::Start(options_, *log);
  ASSERT_TRUE(updater.ok()) << updater.message();
  const auto arrives = [this](uint64_t serial) {
    for (int i = 0; i < 200 && store_.Newest().serial != serial; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return store_.Newest().serial == serial;
  };
  ASSERT_TRUE(arrives(1));
  for (const uint64_t serial : {2, 3}) {
    Publish("-- version " + std::to_string(serial), serial);
    (*updater)->LookNow();
    EXPECT_TRUE(arrives(serial));
  }
}

TEST_F(UpdaterTest, AKilledProcessLeavesTheOldOrTheNewShowAndNeverAMixture) {
  Random random(7);
  map_[0] ^= 1;
  Publish("-- first", 50);
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_TRUE(Fetch().value());
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const int kills = test::IsThorough() ? 250 : 25;
  int finished = 0;
  for (int kill = 0; kill < kills; ++kill) {
    const std::string before = Playable();
    const std::string after = "-- version " + std::to_string(kill);
    map_[static_cast<size_t>(random.Uniform(0.0, 3e6))] ^= 1;
    Publish(after, static_cast<uint64_t>(100 + kill));
    // Some connections are cut, and some bytes are altered on the way.
    server_.cut_after = kill % 4 == 1 ? 1'000'000 : 0;
    server_.altered = kill % 4 == 2 ? static_cast<int64_t>(random.Uniform(0.0, 3e6)) : -1;
    {
      const auto log = MakeSilentLog();
      const auto updater = Updater::Start(options_, *log);
      ASSERT_TRUE(updater.ok()) << updater.message();
      std::this_thread::sleep_for(
          std::chrono::duration<double>(random.Uniform(0.0, 3.0 * seconds)));
      ::kill((*updater)->process(), SIGKILL);
    }
    EXPECT_THAT(Playable(), AnyOf(before, after));
    finished += Playable() == after ? 1 : 0;
  }
  EXPECT_GT(finished, 0);
  server_.cut_after = 0;
  server_.altered = -1;
  const bool is_new = Fetch().value();
  EXPECT_EQ(Playable(), "-- version " + std::to_string(kills - 1)) << is_new;
}

}  // namespace
}  // namespace lararium::player

#include "player/fleet/fleet_options.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "player/app/device_file.h"
#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string Refusal(std::string_view text) {
  const auto address = ParseFleetAddress("--fleet", text);
  return address.ok() ? "" : address.message();
}

TEST(FleetAddress, NamesABrokerWithTlsAndASite) {
  const auto named = ParseFleetAddress("--fleet", "mqtts://broker.museum.example/pompeii");
  ASSERT_TRUE(named.ok()) << named.message();
  EXPECT_EQ(named->host, "broker.museum.example");
  EXPECT_EQ(named->port, 8883);
  EXPECT_EQ(named->site, "pompeii");
  EXPECT_EQ(ParseFleetAddress("", "mqtts://192.168.1.5:18883/a_b-1")->port, 18883);
  const auto long_address = ParseFleetAddress("", "mqtts://[fd00::1]:99/site");
  ASSERT_TRUE(long_address.ok()) << long_address.message();
  EXPECT_EQ(long_address->host, "fd00::1");
  EXPECT_EQ(long_address->port, 99);
  EXPECT_EQ(ParseFleetAddress("", "mqtts://[fd00::1]/site")->host, "fd00::1");
}

TEST(FleetAddress, OthersAreRefusedWithAReason) {
  EXPECT_THAT(Refusal(""), HasSubstr("mqtts://HOST/SITE"));
  EXPECT_THAT(Refusal("mqtt://host/site"), HasSubstr("with TLS"));
  EXPECT_THAT(Refusal("mqtts://host:0/site"), HasSubstr("1 to 65535"));
  EXPECT_THAT(Refusal("mqtts://host:70000/site"), HasSubstr("1 to 65535"));
  EXPECT_THAT(Refusal("mqtts://host:/site"), HasSubstr("1 to 65535"));
  EXPECT_THAT(Refusal("mqtts://host"), HasSubstr("name of a site"));
  EXPECT_THAT(Refusal("mqtts://host/a/b"), HasSubstr("name of a site"));
  EXPECT_THAT(Refusal("mqtts://host/#"), HasSubstr("name of a site"));
  for (const char* host : {"", "[", "]", "[fd00::1", "a b", "user@host", "-v", "fd00::zz", "[]"}) {
    EXPECT_NE(Refusal("mqtts://" + std::string(host) + "/site"), "") << host;
  }
}

TEST(FleetTopics, AreThoseOfTheDeviceAndOfItsGroup) {
  const FleetTopics topics = TopicsOf("pompeii", "tablet-01", "red");
  EXPECT_EQ(topics.state, "lararium/pompeii/device/tablet-01/state");
  EXPECT_EQ(topics.presence, "lararium/pompeii/device/tablet-01/presence");
  EXPECT_THAT(topics.commands,
              ElementsAre("lararium/pompeii/device/tablet-01/do", "lararium/pompeii/group/red/do"));
  EXPECT_EQ(TopicsOf("pompeii", "tablet-01", "").commands.size(), 1u);
}

class FleetOptionsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(WriteFileAtomically(folder_ / "password", "nox-atra\n").ok());
    ::chmod((folder_ / "password").c_str(), 0600);
    options_.address = "mqtts://host/site";
    options_.name = "tablet-01";
    options_.password = folder_ / "password";
  }

  test::TemporaryFolder folder_;
  FleetOptions options_;
};

TEST_F(FleetOptionsTest, NeedEitherAPasswordOrACertificateWithItsKey) {
  EXPECT_TRUE(options_.Validate().ok()) << options_.Validate().message();
  options_.certificate = options_.password;
  EXPECT_THAT(options_.Validate().message(), HasSubstr("either a password file"));
  options_.password.clear();
  EXPECT_THAT(options_.Validate().message(), HasSubstr("and its key"));
  options_.key = options_.certificate;
  EXPECT_TRUE(options_.Validate().ok());
  options_.key = folder_ / "none";
  EXPECT_THAT(options_.Validate().message(), HasSubstr("is missing"));
}

TEST_F(FleetOptionsTest, NamesThatAreNoPartOfATopicAreRefused) {
  for (const char* name : {"", "a/b", "+", "#", "a b", "caf\xc3\xa9"}) {
    options_.name = name;
    EXPECT_THAT(options_.Validate().message(), HasSubstr("not a valid name")) << name;
  }
  options_.name = "a";
  options_.group = "#";
  EXPECT_THAT(options_.Validate().message(), HasSubstr("group"));
}

TEST_F(FleetOptionsTest, APasswordThatOthersCanReadIsRefused) {
  ::chmod(options_.password.c_str(), 0644);
  EXPECT_THAT(options_.Validate().message(), HasSubstr("chmod 600"));
}

TEST_F(FleetOptionsTest, AreAFieldOfTheDeviceFileWithPathsBesideIt) {
  const std::filesystem::path file = folder_ / "device.json";
  ASSERT_TRUE(WriteFileAtomically(file, R"({"schema": 1, "fleet": {"address": "mqtts://host/site",
      "name": "tablet-01", "group": "red", "password": "password"}})")
                  .ok());
  const auto device = LoadDevice(file);
  ASSERT_TRUE(device.ok()) << device.message();
  options_.group = "red";
  EXPECT_EQ(device->fleet, options_);
  const auto wrong =
      ParseDevice(R"({"schema": 1, "fleet": {"address": "http://host/site"}})", "device.json");
  EXPECT_THAT(wrong.message(), HasSubstr("device.json: fleet.address"));
}

}  // namespace
}  // namespace lararium::player

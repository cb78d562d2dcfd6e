#include "player/fleet/fleet_setup.h"

#include <gmock/gmock.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>

#include <memory>

#include "player/app/device_file.h"
#include "player/fleet/fleet_certificates.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class FleetSetupTest : public ::testing::Test {
 protected:
  std::string Read(const std::string& name) { return ReadText(folder_ / name).value(); }
  FleetSetupOptions Change() {
    FleetSetupOptions options;
    options.folder = folder_.path();
    return options;
  }
  FleetSetupOptions New() {
    FleetSetupOptions options = Change();
    options.host = "192.168.1.5";
    options.site = "pompeii";
    options.devices = {"tablet-01:red", "tablet-02"};
    return options;
  }

  test::TemporaryFolder folder_;
};

TEST_F(FleetSetupTest, EachDeviceMayWriteItsStateAndReadItsCommandsAndThoseOfItsGroup) {
  ASSERT_EQ(SetUpFleet(New()).value(), 2u);
  EXPECT_THAT(Read("broker/rights"),
              HasSubstr("user tablet-01\n"
                        "topic write lararium/pompeii/device/tablet-01/state\n"
                        "topic write lararium/pompeii/device/tablet-01/presence\n"
                        "topic write lararium/pompeii/device/tablet-01/statistics\n"
                        "topic read lararium/pompeii/device/tablet-01/do\n"
                        "topic read lararium/pompeii/group/red/do\n"));
}

TEST_F(FleetSetupTest, MembersOfAGroupWriteUnderTheirOwnNamesAndHearOnlyTheirGroup) {
  FleetSetupOptions options = New();
  options.devices = {"tablet-01:red", "tablet-02:blue", "tablet-03:red"};
  options.guides = {"tablet-03"};
  ASSERT_TRUE(SetUpFleet(options).ok());
  EXPECT_THAT(Read("broker/rights"),
              HasSubstr("topic write lararium/pompeii/group/red/all/tablet-01\n"
                        "topic write lararium/pompeii/group/red/to/+/tablet-01\n"
                        "topic write lararium/pompeii/group/red/to/page/+/tablet-01\n"
                        "topic read lararium/pompeii/group/red/all/+\n"
                        "topic read lararium/pompeii/group/red/to/tablet-01/+\n"
                        "topic read lararium/pompeii/group/red/all/page/+\n"
                        "topic read lararium/pompeii/group/red/to/tablet-01/page/+\n"
                        "topic read lararium/pompeii/device/page/+/presence\n"
                        "topic read lararium/pompeii/device/tablet-03/presence\n\n"));
  EXPECT_TRUE(LoadDevice(folder_ / "devices/tablet-03/device.json")->fleet->guide);
  FleetSetupOptions change = Change();
  change.guides = {"tablet-01"};
  ASSERT_TRUE(SetUpFleet(change).ok());
  EXPECT_TRUE(LoadDevice(folder_ / "devices/tablet-01/device.json")->fleet->guide);
  EXPECT_FALSE(LoadDevice(folder_ / "devices/tablet-03/device.json")->fleet->guide);
  FleetSetupOptions many = Change();
  for (int i = 0; i < 40; ++i) {
    many.devices.push_back("headset-" + std::to_string(i) + ":green");
  }
  EXPECT_THAT(SetUpFleet(many).status().message(), HasSubstr("more than 32 devices"));
  change.guides = {"tablet-09"};
  EXPECT_THAT(SetUpFleet(change).status().message(), HasSubstr("no device \"tablet-09\""));
}

TEST_F(FleetSetupTest, PagesOfVisitorsWriteUnderTheirClientsNamesOnly) {
  ASSERT_TRUE(SetUpFleet(New()).ok());
  const std::string rights = Read("broker/rights");
  EXPECT_THAT(rights, HasSubstr("user visitors\n"
                                "topic read lararium/pompeii/device/+/presence\n"
                                "topic read lararium/pompeii/device/page/+/presence\n"
                                "topic read lararium/pompeii/group/+/do\n"
                                "topic read lararium/pompeii/group/+/all/+\n"
                                "pattern read lararium/pompeii/group/+/to/page/%c/+\n"
                                "topic read lararium/pompeii/group/+/all/page/+\n"
                                "pattern read lararium/pompeii/group/+/to/page/%c/page/+\n"
                                "pattern read lararium/pompeii/device/page/%c/do\n"
                                "pattern write lararium/pompeii/device/page/%c/state\n"
                                "pattern write lararium/pompeii/device/page/%c/presence\n"
                                "pattern write lararium/pompeii/group/+/all/page/%c\n"
                                "pattern write lararium/pompeii/group/+/to/+/page/%c\n"
                                "pattern write lararium/pompeii/group/+/to/page/+/page/%c\n"));
  EXPECT_THAT(Read("broker/passwords"), HasSubstr("visitors:"));
  EXPECT_EQ(Read("visitors.password").size(), 21u);
}

TEST_F(FleetSetupTest, TheFolderOfADeviceIsAllThatItsPlayerNeeds) {
  ASSERT_TRUE(SetUpFleet(New()).ok());
  const auto device = LoadDevice(folder_ / "devices/tablet-01/device.json");
  ASSERT_TRUE(device.ok()) << device.message();
  ASSERT_TRUE(device->fleet.has_value());
  EXPECT_TRUE(device->fleet->Validate().ok()) << device->fleet->Validate().message();
  EXPECT_EQ(device->fleet->address, "mqtts://192.168.1.5:8883/pompeii");
  EXPECT_EQ(device->fleet->group, "red");
}

TEST_F(FleetSetupTest, OnlyTheOwnerReadsItsFilesAndNoFileForTheBrokerHasAPassword) {
  ASSERT_TRUE(SetUpFleet(New()).ok());
  const std::string password = Read("devices/tablet-01/password").substr(0, 20);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path())) {
    struct stat info = {};
    ASSERT_EQ(::stat(entry.path().c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 077, 0u) << entry.path();
  }
  EXPECT_THAT(Read("broker/passwords"), Not(HasSubstr(password)));
}

TEST_F(FleetSetupTest, SettingUpAgainKeepsTheAuthorityAndWhatDevicesHaveAlready) {
  ASSERT_TRUE(SetUpFleet(New()).ok());
  const std::string authority = Read("authority.crt");
  const std::string password = Read("devices/tablet-01/password");
  FleetSetupOptions change = Change();
  change.devices = {"tablet-03:red", "tablet-02:blue"};
  ASSERT_EQ(SetUpFleet(change).value(), 3u);
  EXPECT_EQ(Read("authority.crt"), authority);
  EXPECT_EQ(Read("devices/tablet-01/password"), password);
  EXPECT_EQ(LoadDevice(folder_ / "devices/tablet-02/device.json")->fleet->group, "blue");
  FleetSetupOptions removal = Change();
  removal.removed = {"tablet-01"};
  ASSERT_EQ(SetUpFleet(removal).value(), 2u);
  EXPECT_FALSE(FileExists(folder_ / "devices/tablet-01"));
  EXPECT_THAT(Read("broker/passwords"), Not(HasSubstr("tablet-01")));
  EXPECT_THAT(Read("broker/rights"), Not(HasSubstr("tablet-01")));
}

TEST_F(FleetSetupTest, ThePageLiesBesideTheBrokersFilesAndKnowsWhereTheBrokerIs) {
  const test::TemporaryFolder page;
  ASSERT_TRUE(WriteFileAtomically(page / "index.html", "<html>").ok());
  FleetSetupOptions options = New();
  options.page = page.path();
  ASSERT_TRUE(SetUpFleet(options).ok());
  ASSERT_TRUE(SetUpFleet(options).ok()) << "again, over the files that are there";
  EXPECT_EQ(Read("broker/page/index.html"), "<html>");
  const auto settings = ParseJson(Read("broker/page/settings.json"), "settings.json");
  ASSERT_TRUE(settings.ok()) << settings.message();
  EXPECT_EQ((*settings)["host"], "192.168.1.5");
  EXPECT_EQ((*settings)["page_port"], 8884);
  EXPECT_EQ((*settings)["site"], "pompeii");
}

TEST_F(FleetSetupTest, WhatCannotBeDoneChangesNothingAndSaysWhy) {
  const auto refusal = [](const FleetSetupOptions& options) {
    const auto done = SetUpFleet(options);
    return done.ok() ? std::string() : done.message();
  };
  EXPECT_THAT(refusal(Change()), HasSubstr("--host"));
  FleetSetupOptions options = New();
  options.devices = {"staff"};
  EXPECT_THAT(refusal(options), HasSubstr("\"staff\""));
  for (const char* taken : {"visitors", "page"}) {
    options.devices = {taken};
    EXPECT_THAT(refusal(options), HasSubstr("is taken"));
  }
  options.devices = {"../x"};
  EXPECT_THAT(refusal(options), HasSubstr("not a valid name"));
  options.devices = {"a:"};
  EXPECT_THAT(refusal(options), HasSubstr("not a valid name"));
  options.devices = {};
  options.site = "a/b";
  EXPECT_THAT(refusal(options), HasSubstr("site"));
  options = New();
  options.page_port = 8883;
  EXPECT_THAT(refusal(options), HasSubstr("--page-port"));
  options = New();
  options.broker_folder = "/etc/x\nuser root";
  EXPECT_THAT(refusal(options), HasSubstr("without spaces"));
  options = New();
  options.removed = {"../.."};
  EXPECT_THAT(refusal(options), HasSubstr("no device"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(FleetSetupTest, ADamagedFolderIsOneClearError) {
  ASSERT_TRUE(SetUpFleet(New()).ok());
  ASSERT_TRUE(WriteFileAtomically(folder_ / "authority.key", "nonsense").ok());
  EXPECT_THAT(SetUpFleet(Change()).message(), HasSubstr("not a certificate with its key"));
  ASSERT_TRUE(WriteFileAtomically(folder_ / "fleet.json", "{}").ok());
  EXPECT_THAT(SetUpFleet(Change()).message(), HasSubstr("fleet.json"));
  EXPECT_FALSE(ParseFleetPlan(R"({"schema": 1, "host": "h", "site": "s", "port": 1, "page_port": 2,
      "broker_folder": "/b", "certificates": false, "devices": [{"name": "../../x"}]})",
                              "fleet.json")
                   .ok());
}

// Checks a certificate as a client does that trusts the authority.
bool Trusts(const std::string& authority, const std::string& certificate, const char* ip) {
  const auto parse = [](const std::string& pem) {
    const std::unique_ptr<BIO, decltype(&BIO_free)> in(
        BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())), &BIO_free);
    return std::unique_ptr<X509, decltype(&X509_free)>(
        PEM_read_bio_X509(in.get(), nullptr, nullptr, nullptr), &X509_free);
  };
  const auto root = parse(authority);
  const auto leaf = parse(certificate);
  const std::unique_ptr<X509_STORE, decltype(&X509_STORE_free)> store(X509_STORE_new(),
                                                                      &X509_STORE_free);
  X509_STORE_add_cert(store.get(), root.get());
  const std::unique_ptr<X509_STORE_CTX, decltype(&X509_STORE_CTX_free)> context(
      X509_STORE_CTX_new(), &X509_STORE_CTX_free);
  X509_STORE_CTX_init(context.get(), store.get(), leaf.get(), nullptr);
  X509_STORE_CTX_set_purpose(context.get(), X509_PURPOSE_SSL_SERVER);
  return X509_verify_cert(context.get()) == 1 && X509_check_ip_asc(leaf.get(), ip, 0) == 1;
}

TEST(CertificateAuthority, SignsServersForTheirAddressAlone) {
  const auto authority = CertificateAuthority::Make("a");
  ASSERT_TRUE(authority.ok()) << authority.message();
  const auto server = authority->MakeServer("192.168.1.5");
  const std::string root = authority->files().certificate;
  EXPECT_TRUE(Trusts(root, server->certificate, "192.168.1.5"));
  EXPECT_FALSE(Trusts(root, server->certificate, "192.168.1.6"));
  EXPECT_FALSE(Trusts(root, authority->MakeClient("tablet-01")->certificate, "192.168.1.5"));
  const auto other = CertificateAuthority::Make("a");
  EXPECT_FALSE(Trusts(other->files().certificate, server->certificate, "192.168.1.5"));
  EXPECT_FALSE(CertificateAuthority::Parse({root, other->files().key}, "folder").ok());
  EXPECT_TRUE(CertificateAuthority::Parse(authority->files(), "folder").ok());
}

}  // namespace
}  // namespace lararium::player
